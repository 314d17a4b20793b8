#include "core/form/parallel.h"

#include <algorithm>
#include <atomic>
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
    const auto work = [&] {
        for (int k = next++; k < count; k = next++) {
            task(k);
        }
    };
    std::vector<std::jthread> helpers;
    for (int k = 1; k < std::min(threads, count); ++k) {
        helpers.emplace_back(work);
    }
    work();
}

} // namespace rhombloom
