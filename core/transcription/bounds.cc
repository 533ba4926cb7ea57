// CollocationNlp's bounds of states, controls and rows.

#include <algorithm>

#include "core/transcription/collocation_nlp.h"

namespace rollgait {

void CollocationNlp::SetStateBounds() {
  const int n = problem_.model.size();
  lower_ = VectorX::Constant(variables(), -kInfinity);
  upper_ = VectorX::Constant(variables(), kInfinity);
  for (int k = 0; k <= layout_.intervals(); ++k) {
    for (int j = 0; j < n; ++j) {
      const Joint& joint = problem_.model.joint(j);
      lower_(layout_.node(k) + j) = joint.position_min;
      upper_(layout_.node(k) + j) = joint.position_max;
      lower_(layout_.node(k) + n + j) = -joint.velocity_max;
      upper_(layout_.node(k) + n + j) = joint.velocity_max;
    }
  }
  if (problem_.ends) {
    TightenNode(0, problem_.ends->start);
    TightenNode(layout_.intervals(), problem_.ends->end);
  } else {
    // The first node is where the walk begins; without this the problem could slide along x.
    lower_(layout_.node(0) + problem_.forward_joint) = upper_(layout_.node(0) + problem_.forward_joint) = 0;
    // Likewise along y, unless the mirror image at the end says where the middle is.
    if (!problem_.mirrored && problem_.lateral_joint >= 0) {
      lower_(layout_.node(0) + problem_.lateral_joint) = upper_(layout_.node(0) + problem_.lateral_joint) = 0;
    }
  }
  for (int p = 0; p < layout_.phases(); ++p) {
    lower_(layout_.duration(p)) = problem_.phases[p].duration.min;
    upper_(layout_.duration(p)) = problem_.phases[p].duration.max;
  }
  for (int p = 0; p < layout_.phases(); ++p) SetJumpBounds(p);
  lower_(layout_.displacement()) = problem_.displacement.min;
  upper_(layout_.displacement()) = problem_.displacement.max;
}

// A phase may last 20 ms, and a hundredth of a second is half of that.
double CollocationNlp::variable_size(int variable) const {
  const bool is_duration = variable >= layout_.duration(0) && variable < layout_.displacement();
  return is_duration ? lower_(variable) : 1;
}

// Impulses push; velocities before the jump have the bounds of all. The positions there are those of the node after it.
void CollocationNlp::SetJumpBounds(int p) {
  if (!layout_.jumps(p)) return;
  for (const ActiveContact& active : problem_.ActiveContacts(p)) {
    lower_(layout_.impulse(p) + active.offset + static_cast<int>(active.directions.size()) - 1) = 0;
  }
  if (p == 0) return;
  const int n = problem_.model.size(), node = layout_.node(layout_.first_interval(p)) + n;
  const int before = layout_.end_node(layout_.first_interval(p) - 1) + n;
  lower_.segment(before, n) = lower_.segment(node, n);
  upper_.segment(before, n) = upper_.segment(node, n);
}

void CollocationNlp::TightenNode(int k, const EndBounds& bounds) {
  const int size = 2 * problem_.model.size();
  lower_.segment(layout_.node(k), size) = lower_.segment(layout_.node(k), size).cwiseMax(bounds.lower);
  upper_.segment(layout_.node(k), size) = upper_.segment(layout_.node(k), size).cwiseMin(bounds.upper);
}

void CollocationNlp::SetControlBounds() {
  for (int k = 0; k < layout_.intervals(); ++k) {
    for (int j = 0; j < static_cast<int>(problem_.model.actuated().size()); ++j) {
      const Interval bounds = problem_.EffortBounds(layout_.phase(k), j);
      for (int i = 0; i < scheme_.points(); ++i) {
        lower_(layout_.efforts(k, i) + j) = bounds.min / problem_.effort_size();
        upper_(layout_.efforts(k, i) + j) = bounds.max / problem_.effort_size();
      }
    }
    SetForceBounds(k);
  }
}

// Of the forces that are Bernstein coefficients themselves: those at the ends of the interval. The others have rows
// (IntervalPathRows).
void CollocationNlp::SetForceBounds(int k) {
  const int p = layout_.phase(k), last = scheme_.points() - 1;
  const bool zero_at_start = k == layout_.first_interval(p) && problem_.ForcesVanishAtStart(p);
  const bool zero_at_end = layout_.ends_phase(k) && problem_.ForcesVanishAtEnd(p);
  const std::vector<int> taken = problem_.TakenUp(p), given = problem_.GivenUp(p);
  const auto contains = [](const std::vector<int>& contacts, int c) {
    return std::find(contacts.begin(), contacts.end(), c) != contacts.end();
  };
  for (const ActiveContact& active : problem_.ActiveContacts(p)) {
    const int normal = active.offset + static_cast<int>(active.directions.size()) - 1;
    const auto bound = [&](int point, bool zero) {
      lower_(layout_.forces(k, point) + normal) = problem_.min_normal_force / problem_.force_size();
      if (zero) upper_(layout_.forces(k, point) + normal) = 0;
    };
    bound(last, zero_at_end && contains(given, active.contact));
    if (scheme_.tableau().starts_at_node()) bound(0, zero_at_start && contains(taken, active.contact));
  }
}

void CollocationNlp::SetRowBounds() {
  for (int k = 0; k < layout_.intervals(); ++k) first_entry_row_ += blocks_[layout_.phase(k)]->rows();
  first_jump_row_ = first_entry_row_ + entries_.size();
  first_linear_row_ = first_jump_row_ + jumps_.size();
  rows_ = first_linear_row_ + linear_.size();
  row_lower_ = row_upper_ = VectorX::Zero(rows_);
  int row = 0;
  for (int k = 0; k < layout_.intervals(); ++k) {
    const IntervalBlock& block = *blocks_[layout_.phase(k)];
    const IntervalPlace place{k == layout_.first_interval(layout_.phase(k)), layout_.ends_phase(k)};
    block.Bounds(layout_.start(k), layout_.length(k), place, row_lower_.data() + row, row_upper_.data() + row);
    row += block.rows();
  }
  entries_.Bounds(row_lower_.data() + first_entry_row_, row_upper_.data() + first_entry_row_);
  jumps_.Bounds(row_lower_.data() + first_jump_row_, row_upper_.data() + first_jump_row_);
  linear_.Bounds(row_lower_.data() + first_linear_row_, row_upper_.data() + first_linear_row_);
}

}  // namespace rollgait
