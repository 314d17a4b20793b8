#pragma once

#include <atomic>
#include <optional>

#include "core/form/parallel.h"

namespace rhombloom::nesting {

//! \brief The lowest index below \p count for which \p test holds; all cores look, from the lowest on.
//! \details Indices above one that holds may be left out, so the answer never depends on which thread was first.
template <class Test>
std::optional<std::size_t> first_of(std::size_t count, const Test& test)
{
    std::atomic<std::size_t> found = count;
    parallel_tasks(default_threads(), static_cast<int>(count), [&](int k) {
        const auto i = static_cast<std::size_t>(k);
        if (i < found && test(i)) {
            std::size_t lowest = found;
            while (i < lowest && !found.compare_exchange_weak(lowest, i)) {
            }
        }
    });
    return found < count ? std::optional(found.load()) : std::nullopt;
}

} // namespace rhombloom::nesting
