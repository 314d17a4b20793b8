#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <future>
#include <optional>
#include <thread>
#include <vector>

namespace rhombloom::nesting {

//! \brief The lowest index below \p count for which \p test holds; all cores look, from the lowest on.
//! \details Indices above one that holds may be left out, so the answer never depends on which thread was first.
template <class Test>
std::optional<std::size_t> first_of(std::size_t count, const Test& test)
{
    std::atomic<std::size_t> next = 0, found = count;
    const auto work = [&] {
        for (std::size_t i = next++; i < found; i = next++) {
            if (test(i)) {
                std::size_t lowest = found;
                while (i < lowest && !found.compare_exchange_weak(lowest, i)) {
                }
            }
        }
    };
    std::vector<std::future<void>> others;
    for (unsigned t = 1; t < std::thread::hardware_concurrency(); ++t) {
        others.push_back(std::async(std::launch::async, work));
    }
    work();
    for (auto& other : others) {
        other.get();
    }
    return found < count ? std::optional(found.load()) : std::nullopt;
}

//! \brief Calls \p work(i) for every index below \p count on all cores.
template <class Work>
void for_all(std::size_t count, const Work& work)
{
    first_of(count, [&](std::size_t i) {
        work(i);
        return false;
    });
}

} // namespace rhombloom::nesting
