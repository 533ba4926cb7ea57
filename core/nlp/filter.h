#ifndef ROLLGAIT_CORE_NLP_FILTER_H_
#define ROLLGAIT_CORE_NLP_FILTER_H_

#include <algorithm>
#include <utility>
#include <vector>

namespace rollgait {

// Pairs (constraint violation θ, barrier function φ) that a new iterate must not be dominated by (Fletcher and Leyffer,
// 2002).
class Filter {
 public:
  // Nothing with a violation of `largest_theta` or more is acceptable.
  void Reset(double largest_theta) {
    largest_theta_ = largest_theta;
    corners_.clear();
    corners_.reserve(kUsualCorners);
  }
  bool Accepts(double theta, double phi) const {
    if (theta >= largest_theta_) return false;
    return std::none_of(corners_.begin(), corners_.end(),
                        [&](const auto& corner) { return theta >= corner.first && phi >= corner.second; });
  }
  using Corner = std::pair<double, double>;
  const std::vector<Corner>& corners() const { return corners_; }
  void SetCorners(std::vector<Corner> corners) { corners_ = std::move(corners); }
  void Add(double theta, double phi) {
    std::erase_if(corners_, [&](const auto& corner) { return corner.first >= theta && corner.second >= phi; });
    corners_.emplace_back(theta, phi);
  }

 private:
  static constexpr size_t kUsualCorners = 64;  // more than most solves have: it seldom grows between resets
  double largest_theta_ = 0;
  std::vector<Corner> corners_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_FILTER_H_
