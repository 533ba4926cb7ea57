#include "core/validation/force_judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/check.h"
#include "core/contact/admissible_forces.h"
#include "core/math/maximum.h"

namespace rollgait {
namespace {

constexpr double kFrictionFloor = 1e-3;  // of the weight
// Points of one link that are closer than that, m, have no line between them.
constexpr double kLeastDistance = 1e-6;
// More than two contacts on one link: passes over the pairs. Each lowers the largest ratio or leaves it.
constexpr int kPasses = 30;

using Plane = Eigen::Vector2d;

bool Transmits(const ContactSurface& surface, int axis) {
  return std::find(surface.directions.begin(), surface.directions.end(), axis) != surface.directions.end();
}

}  // namespace

void ForceExtremes::Add(const Vector3& force) {
  if (force.hasNaN()) {
    AddNormal(force.sum());
    AddRatio(kInfinity);
    return;
  }
  AddNormal(force.z());
  AddRatio(force.head<2>().norm() / std::max(force.z(), floor()));
}

void ForceExtremes::AddNormal(double normal) {
  any_ = true;
  if (!(normal >= min_normal_)) min_normal_ = std::isnan(normal) ? -kInfinity : normal;
}

double ForceExtremes::floor() const { return kFrictionFloor * weight_; }

ForceJudge::ForceJudge(const Scene& scene, const std::vector<int>& contacts, const ForceBounds& bounds,
                       ForceExtremes* extremes)
    : bounds_(bounds), extremes_(extremes) {
  ROLLGAIT_CHECK(contacts.size() <= kMostContacts);
  for (int index : contacts) {
    const ContactSurface& surface = scene.contacts[index];
    contacts_.push_back({surface.name, surface.joint, Transmits(surface, 0), Transmits(surface, 1)});
  }
  std::array<int, kMostContacts> pairs_of{};
  for (int a = 0; a < this->contacts(); ++a) {
    for (int b = a + 1; b < this->contacts(); ++b) {
      if (contacts_[a].link != contacts_[b].link) continue;
      pairs_.emplace_back(a, b);
      if (++pairs_of[a] > 1 || ++pairs_of[b] > 1) shared_once_ = false;
    }
  }
}

void ForceJudge::SetPrefix(const std::string& prefix) {
  for (Member& member : contacts_) member.name = prefix + member.name;
}

void ForceJudge::Share(const double* rows, double* tangents) const {
  const double floor = extremes_->floor();
  for (int pass = 0; pass < (shared_once_ ? 1 : kPasses); ++pass) {
    for (const auto& [a, b] : pairs_) {
      const double *first = rows + kRows * a, *second = rows + kRows * b;
      Plane d(first[3] - second[3], first[4] - second[4]);
      // A mechanism in the plane does not see what its contacts are apart to the side.
      if (!contacts_[a].along_y && !contacts_[b].along_y) d.y() = 0;
      const bool blocked = (!(contacts_[a].along_x && contacts_[b].along_x) && std::abs(d.x()) > kLeastDistance) ||
                           (!(contacts_[a].along_y && contacts_[b].along_y) && std::abs(d.y()) > kLeastDistance);
      if (blocked || !(d.norm() > kLeastDistance)) continue;
      d.normalize();
      Eigen::Map<Plane> t_a(tangents + 2 * a), t_b(tangents + 2 * b);
      const double shift = LeastRatioShift(t_a, std::max(first[2], floor), t_b, std::max(second[2], floor), d);
      t_a += shift * d;
      t_b -= shift * d;
    }
  }
}

double ForceJudge::FrictionRatio(const double* rows, int* worst) const {
  std::array<double, 2 * kMostContacts> tangents = {};
  bool finite = true;
  for (int c = 0; c < contacts(); ++c) {
    tangents[2 * c] = rows[kRows * c];
    tangents[2 * c + 1] = rows[kRows * c + 1];
    for (int i = 0; i < kRows; ++i) finite = finite && std::isfinite(rows[kRows * c + i]);
  }
  *worst = 0;
  if (!finite) return kInfinity;
  Share(rows, tangents.data());
  double largest = 0;
  for (int c = 0; c < contacts(); ++c) {
    const double normal = std::max(rows[kRows * c + 2], extremes_->floor());
    const double ratio = std::hypot(tangents[2 * c], tangents[2 * c + 1]) / normal;
    if (ratio > largest) largest = ratio, *worst = c;
  }
  return largest;
}

void ForceJudge::AddNormal(int c, double normal, const Instant& at, FindingLog* log) const {
  extremes_->AddNormal(normal);
  log->Raise(Criterion::kPull, std::max((bounds_.min_normal - normal) / extremes_->weight(), 0.0), contacts_[c].name,
             at);
}

void ForceJudge::AddRatio(int c, double ratio, const Instant& at, FindingLog* log) const {
  extremes_->AddRatio(ratio);
  // An infinite ratio is one that is not known; it exceeds even friction without limit.
  const double excess = ratio == kInfinity ? kInfinity : ratio <= bounds_.friction ? 0.0 : ratio / bounds_.friction - 1;
  log->Raise(Criterion::kFriction, excess, contacts_[c].name, at);
}

void ForceJudge::JudgeFriction(const ChebyshevBasis& basis, const MatrixX& coefficients, const MatrixX& samples,
                               int first_row, double start, double length, Instant at, FindingLog* log) const {
  if (contacts() == 0) return;
  std::array<double, kRows* kMostContacts> rows = {};
  const int count = kRows * contacts();
  std::array<double, kMostSamples> ratios = {};
  const std::vector<double>& grid = basis.grid();
  ROLLGAIT_CHECK(grid.size() <= kMostSamples);
  int worst = 0;
  for (size_t k = 0; k < grid.size(); ++k) {
    ratios[k] = FrictionRatio(samples.col(static_cast<int>(k)).data() + first_row, &worst);
    if (ratios[k] == kInfinity) {
      at.time = start + grid[k] * length;
      return AddRatio(worst, kInfinity, at, log);
    }
  }
  const auto ratio = [&](double theta) {
    for (int i = 0; i < count; ++i) rows[i] = ChebyshevBasis::Evaluate(coefficients, first_row + i, theta);
    return FrictionRatio(rows.data(), &worst);
  };
  const Maximum peak = MaximumOverGrid(ratio, grid, {ratios.data(), grid.size()});
  ratio(peak.at);  // for the contact
  at.time = start + peak.at * length;
  AddRatio(worst, peak.value, at, log);
}

void ForceJudge::JudgeNormal(const ChebyshevBasis& basis, const MatrixX& coefficients, const MatrixX& samples,
                             int first_row, double start, double length, Instant at, FindingLog* log) const {
  std::array<double, kMostSamples> pulls = {};
  const std::vector<double>& grid = basis.grid();
  for (int c = 0; c < contacts(); ++c) {
    const int row = first_row + kRows * c + 2;
    bool finite = true;
    for (size_t k = 0; k < grid.size(); ++k) {
      pulls[k] = -samples(row, static_cast<int>(k));
      finite = finite && std::isfinite(pulls[k]);
    }
    Maximum peak{kInfinity, 0};
    if (finite) {
      peak = MaximumOverGrid([&](double theta) { return -ChebyshevBasis::Evaluate(coefficients, row, theta); }, grid,
                             {pulls.data(), grid.size()});
    }
    at.time = start + peak.at * length;
    AddNormal(c, -peak.value, at, log);
  }
}

}  // namespace rollgait
