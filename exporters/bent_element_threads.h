#pragma once

#include <cstddef>
#include <exception>
#include <thread>

namespace rhombloom {

//! \brief Call \p work(i) for all i < count in two threads; the work on different i must not depend on each other.
template <class Work>
void for_each_in_two_threads(std::size_t count, const Work& work)
{
    std::exception_ptr failure;
    const auto run = [&](std::size_t first) {
        for (std::size_t i = first; i < count; i += 2) {
            work(i);
        }
    };
    std::thread other([&] {
        try {
            run(1);
        } catch (...) {
            failure = std::current_exception();
        }
    });
    try {
        run(0);
    } catch (...) {
        other.join();
        throw;
    }
    other.join();
    if (failure) {
        std::rethrow_exception(failure);
    }
}

} // namespace rhombloom
