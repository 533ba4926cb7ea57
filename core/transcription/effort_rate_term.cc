#include "core/transcription/effort_rate_term.h"

#include <algorithm>

namespace rollgait {
namespace {

// Where the effort of actuated joint j comes from in the mirror image, and with which sign.
std::pair<int, double> MirroredEffort(const Model& model, int j) {
  const std::vector<int>& actuated = model.actuated();
  const Joint& joint = model.joint(actuated[j]);
  if (joint.mirror_joint < 0) return {j, 1};
  const auto source = std::find(actuated.begin(), actuated.end(), joint.mirror_joint);
  ROLLGAIT_CHECK(source != actuated.end());
  return {static_cast<int>(source - actuated.begin()), joint.mirror_sign};
}

}  // namespace

std::vector<EffortLink> ConsecutiveEfforts(const OptimalControlProblem& problem, const DecisionLayout& layout,
                                           const VectorX& point_fractions) {
  const int joints = static_cast<int>(problem.model.actuated().size());
  const int last = layout.points() - 1;
  std::vector<EffortLink> links;
  const auto add = [&](int from_interval, int from_point, int to_interval, int to_point, double fraction,
                       bool mirrored) {
    EffortLink link;
    for (int j = 0; j < joints; ++j) {
      const auto [source, sign] = mirrored ? MirroredEffort(problem.model, j) : std::pair(j, 1.0);
      link.from.push_back(layout.efforts(from_interval, from_point) + j);
      link.to.push_back(layout.efforts(to_interval, to_point) + source);
      link.sign.push_back(sign);
    }
    link.phase = layout.phase(to_interval);
    link.ratio = fraction * layout.length(to_interval);
    links.push_back(std::move(link));
  };
  for (int k = 0; k < layout.intervals(); ++k) {
    for (int i = 0; i < last; ++i) add(k, i, k, i + 1, point_fractions(i + 1) - point_fractions(i), false);
    if (k + 1 < layout.intervals()) add(k, last, k + 1, 0, point_fractions(0), false);
  }
  add(layout.intervals() - 1, last, 0, 0, point_fractions(0), problem.mirrored);
  return links;
}

EffortRateTerm::EffortRateTerm(const OptimalControlProblem& problem, const EffortRateCost& cost,
                               const DecisionLayout& layout, const EliminatedScheme& scheme)
    : layout_(layout),
      effort_size_(problem.effort_size()),
      weights_(cost.weights.data(), cost.weights.data() + cost.weights.size()) {
  std::vector<int> unknowns;
  for (EffortLink& link : ConsecutiveEfforts(problem, layout, scheme.tableau().c)) {
    if (link.ratio == 0) continue;
    const int duration = layout.duration(link.phase);
    for (size_t j = 0; j < link.from.size(); ++j) {
      const int from = link.from[j], to = link.to[j];
      unknowns.push_back(from);
      unknowns.push_back(to);
      AddPair(from, from);
      AddPair(to, to);
      AddPair(from, to);
      AddPair(duration, from);
      AddPair(duration, to);
    }
    AddPair(duration, duration);
    links_.push_back(std::move(link));
  }
  SetUnknowns(std::move(unknowns));
}

double EffortRateTerm::Integral(const double* x) {
  double sum = 0;
  for (const EffortLink& link : links_) {
    double squares = 0;
    for (size_t j = 0; j < weights_.size(); ++j) {
      const double difference = Difference(x, link, j);
      squares += weights_[j] * difference * difference;
    }
    sum += squares / (link.ratio * x[layout_.duration(link.phase)]);
  }
  return sum;
}

void EffortRateTerm::AddGradient(const double* x, double factor, double* gradient) {
  for (const EffortLink& link : links_) {
    const double duration = x[layout_.duration(link.phase)], step = link.ratio * duration;
    for (size_t j = 0; j < weights_.size(); ++j) {
      const double difference = Difference(x, link, j);
      const double slope = factor * 2 * weights_[j] * difference / step;
      gradient[link.to[j]] += slope * effort_size_ * link.sign[j];
      gradient[link.from[j]] -= slope * effort_size_;
      gradient[layout_.duration(link.phase)] -= 0.5 * slope * difference / duration;
    }
  }
}

void EffortRateTerm::Hessian(const double* x, double factor, double* values) {
  for (const EffortLink& link : links_) {
    const double duration = x[layout_.duration(link.phase)], step = link.ratio * duration;
    double squares = 0;
    for (size_t j = 0; j < weights_.size(); ++j) {
      const double difference = Difference(x, link, j);
      const double curvature = factor * 2 * weights_[j] / step;
      const double own = curvature * effort_size_ * effort_size_;
      const double against_duration = curvature * effort_size_ * difference / duration;
      *values++ = own;
      *values++ = own;
      *values++ = -own * link.sign[j];
      *values++ = against_duration;
      *values++ = -against_duration * link.sign[j];
      squares += curvature * difference * difference;
    }
    *values++ = squares / (duration * duration);
  }
}

}  // namespace rollgait
