#include "core/building/assembly_plan.h"

#include "core/building/orders.h"

namespace rhombloom {

AssemblyPlan assembly_plan(const Replay& replay, const Element& element, Order order)
{
    const BuildHistory history = build_history(replay, element);
    StageCoverage coverage(replay);
    const PlanSources sources{replay, element, history, coverage};
    return order == Order::Best ? best_plan(sources) : finish_plan(sources, paper_order(sources), Order::Paper);
}

} // namespace rhombloom
