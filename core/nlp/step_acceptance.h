#ifndef ROLLGAIT_CORE_NLP_STEP_ACCEPTANCE_H_
#define ROLLGAIT_CORE_NLP_STEP_ACCEPTANCE_H_

#include <vector>

#include "core/nlp/filter.h"

namespace rollgait {

// A point on a search line: constraint violation θ and barrier function φ; with the slope of φ along the step where it
// starts.
struct LinePoint {
  double theta = 0, phi = 0, slope = 0;
};

// Which steps a line search takes: those that lower φ enough where the constraints nearly hold, elsewhere those that
// lower θ or φ, and none that the filter has seen (Wächter and Biegler, section 2.3).
class StepAcceptance {
 public:
  // For points with violations of about that of the first one.
  void Begin(double first_theta);
  // φ is another function from here on.
  void ForgetFilter() { filter_.Reset(theta_max_); }
  // Whether the step of length α leads from one point to the other acceptably. The filter grows by what is accepted.
  bool Accepts(const LinePoint& from, double alpha, const LinePoint& to);
  // From here on nothing is acceptable that is no better than this point.
  void Exclude(const LinePoint& point);
  // Whether the filter takes a point, wherever it was reached from.
  bool TakesFromAnywhere(const LinePoint& point) const;
  // What it knows of the steps so far, from which it can go on.
  struct Memory {
    double theta_min = 0, theta_max = 0;
    std::vector<Filter::Corner> corners;
  };
  Memory memory() const { return {theta_min_, theta_max_, filter_.corners()}; }
  void Restore(const Memory& memory);
  // Below this length no step is tried.
  double SmallestStep(const LinePoint& from) const;

 private:
  Filter filter_;
  double theta_min_ = 0, theta_max_ = 0;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_STEP_ACCEPTANCE_H_
