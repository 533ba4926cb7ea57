// The order in which the Newton system of a CollocationNlp is eliminated.

#include <algorithm>

#include "core/transcription/collocation_nlp.h"

namespace rollgait {

EliminationGroups CollocationNlp::elimination_groups() const {
  const int n = problem_.model.size(), efforts = static_cast<int>(problem_.model.actuated().size());
  const int per_interval = scheme_.points() + 1;
  const int last = (layout_.intervals() + 1) * per_interval;
  EliminationGroups groups;
  groups.variables.assign(variables(), last);
  for (int k = 0; k < layout_.intervals(); ++k) {
    const int group = k * per_interval + scheme_.points();
    std::fill(groups.variables.begin() + layout_.node(k), groups.variables.begin() + layout_.end_node(k), group);
    // What a jump has between the two goes with the node after it.
    std::fill(groups.variables.begin() + layout_.end_node(k), groups.variables.begin() + layout_.node(k + 1),
              group + per_interval);
    for (int i = 0; i < scheme_.points(); ++i) {
      std::fill_n(groups.variables.begin() + layout_.efforts(k, i), efforts, k * per_interval + i);
    }
  }
  std::fill_n(groups.variables.begin() + layout_.node(layout_.intervals()), 2 * n, last - 1);
  std::fill_n(groups.variables.begin() + layout_.node(0), 2 * n, last);
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
