#include "core/transcription/layout.h"

namespace rollgait {

Mesh Mesh::Uniform(const std::vector<int>& intervals) {
  Mesh mesh;
  for (int count : intervals) mesh.fractions.emplace_back(count, 1.0 / count);
  return mesh;
}

std::vector<int> Mesh::Intervals() const {
  std::vector<int> intervals;
  for (const auto& phase : fractions) intervals.push_back(static_cast<int>(phase.size()));
  return intervals;
}

DecisionLayout::DecisionLayout(const OptimalControlProblem& problem, const Mesh& mesh, int points)
    : n_(problem.model.size()), efforts_(static_cast<int>(problem.model.actuated().size())), points_(points) {
  int offset = 0;
  first_interval_.push_back(0);
  for (size_t p = 0; p < mesh.fractions.size(); ++p) {
    const PointLayout layout = problem.Layout(static_cast<int>(p));
    per_point_.push_back(layout.efforts + layout.forces);
    const bool jumps = problem.Jumps(static_cast<int>(p));
    if (jumps && p > 0) offset += 2 * n_;  // the end of the phase before
    impulse_.push_back(jumps ? offset : -1);
    if (jumps) offset += layout.forces;
    double start = 0;
    for (double length : mesh.fractions[p]) {
      phase_of_.push_back(static_cast<int>(p));
      start_.push_back(start);
      length_.push_back(length);
      start += length;
      node_.push_back(offset);
      offset += 2 * n_ + interior_size(static_cast<int>(p));
    }
    first_interval_.push_back(static_cast<int>(phase_of_.size()));
  }
  node_.push_back(offset);
  durations_ = offset + 2 * n_;
  displacement_ = durations_ + phases();
}

}  // namespace rollgait
