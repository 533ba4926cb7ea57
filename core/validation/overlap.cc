#include "core/validation/overlap.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>

#include "core/base/check.h"
#include "core/trajectory/sampling.h"
#include "core/validation/body_overlap.h"
#include "core/validation/residuals.h"

namespace rollgait {
namespace {

constexpr int kSamples = 12;    // an interval
constexpr int kTimeSteps = 40;  // of the search in time: each shortens the bracket by 0.62
constexpr double kGolden = 0.6180339887498949;

// All bodies at one instant.
using Posture = std::vector<PosedBody>;

PosedBody ShapeOf(const Surface& surface) {
  using Support = std::function<double(const Vector3&)>;
  PosedBody body;
  const std::optional<WalkingShape> shape = surface.walking();
  ROLLGAIT_CHECK(shape);  // no scene that walks has another surface: the checks of own models refuse it
  body.semi_axes = shape->semi_axes;
  if (shape->support) body.norm = std::make_shared<const Support>(shape->support);
  return body;
}

// No point of the body is further from its centre. What is no ellipsoid may fill the box around it.
double Reach(const PosedBody& body) { return body.norm ? body.semi_axes.norm() : body.semi_axes.maxCoeff(); }

class IntervalSearch {
 public:
  IntervalSearch(const Scene& scene, const BodyDynamics& dynamics) : scene_(scene), dynamics_(dynamics) {
    postures_.resize(kSamples + 1);
    moved_.resize(kSamples);
    last_normal_.resize(scene.pairs.size(), Vector3::UnitY());
    for (const BodySurface& body : scene.bodies) shapes_.push_back(ShapeOf(body.placed.surface));
  }

  struct Deepest {
    double depth = 0;     // m
    double fraction = 0;  // of the interval
  };

  void Start(const IntervalPolynomials& interval) {
    interval_ = &interval;
    for (int k = 0; k <= kSamples; ++k) Pose(Fraction(k), &postures_[k]);
    for (int k = 0; k < kSamples; ++k) {
      moved_[k].resize(scene_.bodies.size());
      for (size_t b = 0; b < scene_.bodies.size(); ++b) moved_[k][b] = Moved(postures_[k][b], postures_[k + 1][b]);
    }
  }

  Deepest Find(int pair) {
    double distances[kSamples + 1] = {};
    for (int k = 0; k <= kSamples; ++k) distances[k] = Near(pair, k) ? Distance(pair, postures_[k]) : kInfinity;
    Deepest deepest;
    for (int k = 0; k <= kSamples; ++k) {
      const double before = k > 0 ? distances[k - 1] : kInfinity, after = k < kSamples ? distances[k + 1] : kInfinity;
      if (distances[k] == kInfinity || distances[k] > before || distances[k] > after) continue;
      closest_ = {distances[k], Fraction(k)};
      Descend(pair, Fraction(std::max(k - 1, 0)), Fraction(std::min(k + 1, kSamples)));
      if (closest_.distance >= 0) continue;
      Pose(closest_.fraction, &between_);
      const double depth = OverlapDepth(between_[scene_.pairs[pair].first], between_[scene_.pairs[pair].second]);
      if (depth > deepest.depth) deepest = {depth, closest_.fraction};
    }
    return deepest;
  }

 private:
  static double Fraction(int k) { return static_cast<double>(k) / kSamples; }

  void Pose(double fraction, Posture* posture) {
    interval_->Evaluate(fraction, &sample_);
    dynamics_.ComputeState(sample_.position, sample_.velocity, &state_);
    posture->resize(scene_.bodies.size());
    for (size_t b = 0; b < scene_.bodies.size(); ++b) {
      const BodySurface& body = scene_.bodies[b];
      const BodyDynamics::Link& link = state_[body.joint];
      (*posture)[b] = shapes_[b];
      (*posture)[b].R_WE = link.R_WL * body.placed.R_BE;
      (*posture)[b].p_WE = link.p_WL + link.R_WL * body.placed.p_BE;
    }
  }

  // No point of the body moves further than this.
  static double Moved(const PosedBody& from, const PosedBody& to) {
    return (to.p_WE - from.p_WE).norm() + Reach(from) * (to.R_WE - from.R_WE).norm();
  }

  // Whether the pair may touch between sample k and the samples next to it. An instant in between is within half of
  // what the bodies move from one sample to the next; the other half is for paths that are not straight.
  bool Near(int pair, int k) {
    const int first = scene_.pairs[pair].first, second = scene_.pairs[pair].second;
    const PosedBody &a = postures_[k][first], &b = postures_[k][second];
    double reach = 0;
    for (const int step : {k - 1, k}) {
      if (step >= 0 && step < kSamples) reach = std::max(reach, moved_[step][first] + moved_[step][second]);
    }
    const double centres = (b.p_WE - a.p_WE).norm();
    // A NaN is near, so that it cannot hide.
    if (centres - Reach(a) - Reach(b) > reach) return false;
    if (PlaneDistance(a, b, last_normal_[pair]) > reach) return false;
    last_normal_[pair] = FindScaledContact(a, b).nu;
    return !(PlaneDistance(a, b, last_normal_[pair]) > reach);
  }

  // At the scaled contact.
  double Distance(int pair, const Posture& posture) const {
    const PosedBody &a = posture[scene_.pairs[pair].first], &b = posture[scene_.pairs[pair].second];
    const double distance = PlaneDistance(a, b, FindScaledContact(a, b).nu);
    return std::isnan(distance) ? -kInfinity : distance;
  }

  // Golden section; lowers closest_.
  void Descend(int pair, double low, double high) {
    const auto at = [&](double fraction) {
      Pose(fraction, &between_);
      const double distance = Distance(pair, between_);
      if (distance < closest_.distance) closest_ = {distance, fraction};
      return distance;
    };
    double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
    double at_left = at(left), at_right = at(right);
    // Near its minimum the distance is flat: a bracket of 1e-5 of an interval leaves out less than 1e-9 m.
    for (int i = 0; i < kTimeSteps && high - low > 1e-5; ++i) {
      if (at_left < at_right) {
        high = right;
        right = left;
        at_right = at_left;
        left = high - kGolden * (high - low);
        at_left = at(left);
      } else {
        low = left;
        left = right;
        at_left = at_right;
        right = low + kGolden * (high - low);
        at_right = at(right);
      }
    }
  }

  struct Closest {
    double distance = kInfinity;
    double fraction = 0;
  };

  const Scene& scene_;
  const BodyDynamics& dynamics_;
  std::vector<PosedBody> shapes_;  // of the bodies, without their place
  Closest closest_;
  const IntervalPolynomials* interval_ = nullptr;
  std::vector<Posture> postures_;
  std::vector<std::vector<double>> moved_;  // m, by step and body
  std::vector<Vector3> last_normal_;        // of each pair: most often it still separates
  MotionSample sample_;
  BodyDynamics::State state_;
  Posture between_;
};

}  // namespace

std::vector<int> OverlapFindings::Deeper(double bound) const {
  std::vector<int> deeper;
  for (size_t p = 0; p < pairs.size(); ++p) {
    if (pairs[p] > bound) deeper.push_back(static_cast<int>(p));
  }
  return deeper;
}

OverlapFindings MeasureOverlap(const Scene& scene, const BodyDynamics& dynamics, const Trajectory& trajectory) {
  OverlapFindings findings;
  findings.pairs.resize(scene.pairs.size(), 0);
  IntervalSearch search(scene, dynamics);
  for (int p = 0; p < static_cast<int>(trajectory.phases.size()); ++p) {
    const int intervals = static_cast<int>(trajectory.phases[p].node_times.size()) - 1;
    for (int k = 0; k < intervals; ++k) {
      findings.intervals.push_back(0);
      if (scene.pairs.empty()) continue;
      const IntervalPolynomials interval(trajectory, p, k);
      search.Start(interval);
      for (int pair = 0; pair < static_cast<int>(scene.pairs.size()); ++pair) {
        const IntervalSearch::Deepest deepest = search.Find(pair);
        RaiseTo(deepest.depth, &findings.intervals.back());
        RaiseTo(deepest.depth, &findings.pairs[pair]);
        if (deepest.depth <= findings.worst.value) continue;
        findings.worst = {deepest.depth, scene.PairName(pair), p,
                          interval.start() + deepest.fraction * interval.length()};
      }
    }
  }
  return findings;
}

}  // namespace rollgait
