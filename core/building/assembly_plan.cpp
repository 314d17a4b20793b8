#include "core/building/assembly_plan.h"

#include "core/building/orders.h"

namespace rhombloom {

AssemblyPlan assembly_plan(const Replay& replay, const Element& element, Order order)
{
    const BuildHistory history = build_history(replay, element);
    if (order == Order::Best) {
        return best_plan(replay, element, history);
    }
    return finish_plan(replay, element, history, paper_order(replay, history), Order::Paper);
}

} // namespace rhombloom
