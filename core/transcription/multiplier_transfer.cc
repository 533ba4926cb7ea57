// Multipliers from one mesh to another. A multiplier of a row at a collocation point approximates the step h b_i times
// a function of time that does not depend on the mesh; that function is interpolated linearly in time, for each point
// of the scheme apart.

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "core/transcription/collocation_nlp.h"

namespace rollgait {
namespace {

// Two neighbouring columns of samples and the share of the second.
struct Bracket {
  int first, second;
  double share;
};

Bracket Find(const std::vector<double>& times, double time) {
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  const int second = std::min(static_cast<int>(after - times.begin()), static_cast<int>(times.size()) - 1);
  const int first = std::max(0, second - 1);
  if (first == second) return {first, second, 0};
  return {first, second, std::clamp((time - times[first]) / (times[second] - times[first]), 0.0, 1.0)};
}

}  // namespace

std::vector<double> CollocationNlp::PointTimes(int phase, int point) const {
  std::vector<double> times;
  for (int k = 0; k < layout_.intervals_in(phase); ++k) {
    const int interval = layout_.first_interval(phase) + k;
    times.push_back(layout_.start(interval) + scheme_.tableau().c(point) * layout_.length(interval));
  }
  return times;
}

int CollocationNlp::FirstRow(int interval) const {
  int row = 0;
  for (int k = 0; k < interval; ++k) row += blocks_[layout_.phase(k)]->rows();
  return row;
}

void CollocationNlp::TransferMultipliers(const CollocationNlp& from, const NlpResult& of, NlpStart* start) const {
  start->constraint_multipliers = VectorX::Zero(constraints());
  start->lower_bound_multipliers = VectorX::Zero(variables());
  start->upper_bound_multipliers = VectorX::Zero(variables());
  for (int p = 0; p < layout_.phases(); ++p) {
    for (int i = 0; i < scheme_.points(); ++i) TransferPoint(from, of, p, i, start);
    TransferPath(from, of, p, start);
  }
  TransferNodes(from, of, start);
  for (int p = 0; p < layout_.phases(); ++p) TransferJump(from, of, p, start);
  const int fixed = entries_.size() + jumps_.size() + std::min(linear_.size(), from.linear_.size());
  start->constraint_multipliers.segment(first_entry_row_, fixed) =
      of.constraint_multipliers.segment(from.first_entry_row_, fixed);
  const int tail = layout_.phases() + 1, end = variables() - tail, other_end = from.variables() - tail;
  start->lower_bound_multipliers.tail(tail) = of.lower_bound_multipliers.segment(other_end, tail);
  start->upper_bound_multipliers.tail(tail) = of.upper_bound_multipliers.segment(other_end, tail);
  ROLLGAIT_CHECK(layout_.duration(0) == end);
}

// Rows and controls of point i of the intervals of phase p.
void CollocationNlp::TransferPoint(const CollocationNlp& from, const NlpResult& of, int p, int i,
                                   NlpStart* start) const {
  const std::vector<double> times = PointTimes(p, i), other_times = from.PointTimes(p, i);
  // Rows of pairs of bodies, which another program may lack, come last.
  const int rows = std::min(blocks_[p]->PointRows(i), from.blocks_[p]->PointRows(i));
  const int offset = blocks_[p]->FirstRow(i), other_offset = from.blocks_[p]->FirstRow(i);
  const int controls = layout_.controls(p);
  for (size_t k = 0; k < times.size(); ++k) {
    const Bracket at = Find(other_times, times[k]);
    const int interval = layout_.first_interval(p) + static_cast<int>(k);
    const auto add = [&](int index, double share) {
      if (share == 0) return;
      const int other = from.layout_.first_interval(p) + index;
      const double factor = share * layout_.length(interval) / from.layout_.length(other);
      start->constraint_multipliers.segment(FirstRow(interval) + offset, rows) +=
          factor * of.constraint_multipliers.segment(from.FirstRow(other) + other_offset, rows);
      start->lower_bound_multipliers.segment(layout_.efforts(interval, i), controls) +=
          factor * of.lower_bound_multipliers.segment(from.layout_.efforts(other, i), controls);
      start->upper_bound_multipliers.segment(layout_.efforts(interval, i), controls) +=
          factor * of.upper_bound_multipliers.segment(from.layout_.efforts(other, i), controls);
    };
    add(at.first, 1 - at.share);
    add(at.second, at.share);
  }
}

// Rows between the points, by the time of the middle of their interval; those that the other one lacks keep 0.
void CollocationNlp::TransferPath(const CollocationNlp& from, const NlpResult& of, int p, NlpStart* start) const {
  const IntervalPathRows &rows = blocks_[p]->path(), &other_rows = from.blocks_[p]->path();
  std::map<std::string, int> places;
  for (int r = 0; r < other_rows.size(); ++r) places[other_rows.Key(r)] = from.blocks_[p]->FirstPathRow() + r;
  const auto middles = [p](const DecisionLayout& layout) {
    std::vector<double> times;
    for (int k = layout.first_interval(p); k < layout.first_interval(p + 1); ++k) {
      times.push_back(layout.start(k) + layout.length(k) / 2);
    }
    return times;
  };
  const std::vector<double> times = middles(layout_), other_times = middles(from.layout_);
  const int count = static_cast<int>(other_times.size());
  for (size_t k = 0; k < times.size(); ++k) {
    const Bracket at = Find(other_times, times[k]);
    const int interval = layout_.first_interval(p) + static_cast<int>(k);
    const int first = FirstRow(interval) + blocks_[p]->FirstPathRow();
    for (const auto& [index, share] : {std::pair(at.first, 1 - at.share), std::pair(at.second, at.share)}) {
      const int other = from.layout_.first_interval(p) + index, other_first = from.FirstRow(other);
      const double factor = share * layout_.length(interval) / from.layout_.length(other);
      for (int r = 0; r < rows.size(); ++r) {
        const auto place = places.find(rows.Key(r));
        if (place == places.end()) continue;
        // An equation at an end of the phase is no sample of a function of time: it goes to that end alone, as it is.
        const bool other_end = (index == 0 && rows.ChangesAtStart(r)) || (index + 1 == count && rows.ChangesAtEnd(r));
        const bool own_end = (k == 0 && rows.ChangesAtStart(r)) || (k + 1 == times.size() && rows.ChangesAtEnd(r));
        if (other_end || own_end) continue;
        start->constraint_multipliers(first + r) += factor * of.constraint_multipliers(other_first + place->second);
      }
    }
  }
  for (const bool at_start : {true, false}) {
    const int to = at_start ? 0 : static_cast<int>(times.size()) - 1, source = at_start ? 0 : count - 1;
    const int first = FirstRow(layout_.first_interval(p) + to) + blocks_[p]->FirstPathRow();
    const int other_first = from.FirstRow(from.layout_.first_interval(p) + source);
    for (int r = 0; r < rows.size(); ++r) {
      const auto place = places.find(rows.Key(r));
      if (place == places.end() || !(at_start ? rows.ChangesAtStart(r) : rows.ChangesAtEnd(r))) continue;
      start->constraint_multipliers(first + r) = of.constraint_multipliers(other_first + place->second);
    }
  }
}

// Bounds of node states: those of the nearest old node of the same phase.
void CollocationNlp::TransferNodes(const CollocationNlp& from, const NlpResult& of, NlpStart* start) const {
  const int size = 2 * problem_.model.size();
  for (int k = 0; k <= layout_.intervals(); ++k) {
    const bool end = k == layout_.intervals();
    const int p = layout_.phase(end ? k - 1 : k);
    const double time = end ? 1 : layout_.start(k);
    int nearest = from.layout_.first_interval(p);
    double distance = kInfinity;
    const int last = nearest + from.layout_.intervals_in(p);
    for (int other = nearest; other <= last; ++other) {
      const double other_time = other == last ? 1 : from.layout_.start(other);
      if (std::abs(other_time - time) < distance) {
        distance = std::abs(other_time - time);
        nearest = other;
      }
    }
    start->lower_bound_multipliers.segment(layout_.node(k), size) =
        of.lower_bound_multipliers.segment(from.layout_.node(nearest), size);
    start->upper_bound_multipliers.segment(layout_.node(k), size) =
        of.upper_bound_multipliers.segment(from.layout_.node(nearest), size);
  }
}

// Bounds of the impulses and of the state before a jump, which are there on every mesh.
void CollocationNlp::TransferJump(const CollocationNlp& from, const NlpResult& of, int p, NlpStart* start) const {
  if (!layout_.jumps(p)) return;
  const int states = p > 0 ? 2 * problem_.model.size() : 0, size = states + layout_.impulse_size(p);
  const int to = layout_.impulse(p) - states, source = from.layout_.impulse(p) - states;
  start->lower_bound_multipliers.segment(to, size) = of.lower_bound_multipliers.segment(source, size);
  start->upper_bound_multipliers.segment(to, size) = of.upper_bound_multipliers.segment(source, size);
}

}  // namespace rollgait
