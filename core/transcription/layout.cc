#include "core/transcription/layout.h"

#include <numeric>

namespace rollgait {

int Mesh::total() const { return std::accumulate(intervals.begin(), intervals.end(), 0); }

DecisionLayout::DecisionLayout(const OptimalControlProblem& problem, const Mesh& mesh, int points)
    : n_(problem.model.size()), efforts_(static_cast<int>(problem.model.actuated().size())), points_(points) {
  int offset = 0;
  first_interval_.push_back(0);
  for (size_t p = 0; p < mesh.intervals.size(); ++p) {
    const PointLayout layout = problem.Layout(static_cast<int>(p));
    per_point_.push_back(layout.efforts + layout.forces);
    for (int k = 0; k < mesh.intervals[p]; ++k) {
      phase_of_.push_back(static_cast<int>(p));
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
