// The order in which the Newton system of a CollocationNlp is eliminated. For each interval in turn
//  * the efforts of each point with the rows that hold them: leaves, which touch the two nodes, the forces of their
//    point and, where rates of efforts cost something or efforts do not jump, the efforts of the points beside them;
//  * the forces of the points but the first, with the rows that hold them;
//  * the node before the interval with what remains. Rate costs, and efforts that do not jump, tie the efforts of
//    the first point to the interval before; as leaves they would carry all that the chain of nodes carries, so they
//    then go with the node.

#include <algorithm>

#include "core/transcription/collocation_nlp.h"

namespace rollgait {

EliminationGroups CollocationNlp::elimination_groups() const {
  const int n = problem_.model.size();
  const int points = scheme_.points(), per_interval = points + 2;
  const int last = (layout_.intervals() + 1) * per_interval;
  EliminationGroups groups;
  groups.variables.assign(variables(), last);
  const auto assign = [&groups](int first, int end, int group) {
    std::fill(groups.variables.begin() + first, groups.variables.begin() + end, group);
  };
  const bool tied = scheme_.tableau().joins_efforts() ||
                    std::any_of(problem_.costs.begin(), problem_.costs.end(),
                                [](const CostDescription& cost) { return cost.IsRateOf(RateCost::Of::kEfforts); });
  for (int k = 0; k < layout_.intervals(); ++k) {
    const int first = k * per_interval, between = first + points, node = first + points + 1;
    assign(layout_.node(k), layout_.end_node(k), node);
    // What a jump has between the two goes with the node after it.
    assign(layout_.end_node(k), layout_.node(k + 1), node + per_interval);
    const int controls = layout_.controls(layout_.phase(k));
    for (int i = tied ? 1 : 0; i < points; ++i) {
      assign(layout_.efforts(k, i), layout_.forces(k, i), first + i);
      if (i > 0) assign(layout_.forces(k, i), layout_.efforts(k, i) + controls, between);
    }
  }
  assign(layout_.node(layout_.intervals()), layout_.node(layout_.intervals()) + 2 * n, last - 1);
  assign(layout_.node(0), layout_.node(0) + 2 * n, last);
  // A row goes with the earliest of its unknowns, which it determines. Linear rows tie unknowns of different intervals,
  // and go with the latest but for those that come last.
  groups.constraints.assign(constraints(), last);
  std::vector<int> latest(constraints(), -1);
  for (int e = 0; e < jacobian_pattern_.size(); ++e) {
    const int row = jacobian_pattern_.rows[e], group = groups.variables[jacobian_pattern_.columns[e]];
    groups.constraints[row] = std::min(groups.constraints[row], group);
    if (group < last) latest[row] = std::max(latest[row], group);
  }
  for (int row = first_linear_row_; row < constraints(); ++row) {
    if (latest[row] >= 0) groups.constraints[row] = latest[row];
  }
  return groups;
}

}  // namespace rollgait
