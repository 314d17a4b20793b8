#include "core/form/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace rhombloom {

int default_threads()
{
    return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 8);
}

void parallel_tasks(int threads, int count, const std::function<void(int)>& task)
{
    std::atomic<int> next = 0;
    std::exception_ptr failure;
    std::once_flag failed;
    const auto work = [&] {
        try {
            for (int k = next++; k < count; k = next++) {
                task(k);
            }
        } catch (...) {
            std::call_once(failed, [&] { failure = std::current_exception(); });
        }
    };
    {
        std::vector<std::jthread> helpers;
        for (int k = 1; k < std::min(threads, count); ++k) {
            helpers.emplace_back(work);
        }
        work();
    }
    if (failure) {
        std::rethrow_exception(failure);
    }
}

} // namespace rhombloom
