// What the flat sides of friction pyramids cost.
//
// At a Bernstein coefficient with the force (f_t, f_n) the sides i with the normals n_i and the multipliers λ_i hold
// the tangential force back with the pull G = Σ λ_i n_i. With f_n as it is, the pyramid bounds G·f_t, and this solution
// attains the bound; the cone would bound it by μ f_n |G|. The difference μ f_n |G| − G·f_t >= 0 is what the cone would
// save to first order. The force would then meet the cone between the directions of f_t, which costs of higher order
// keep, and of G; the direction in the middle stands for it.

#include <cmath>
#include <map>
#include <numbers>

#include "core/transcription/collocation_nlp.h"

namespace rollgait {
namespace {

double AngleOf(const Eigen::Vector2d& direction) {
  const double angle = std::atan2(direction.y(), direction.x());
  return angle < 0 ? angle + 2 * std::numbers::pi : angle;
}

// The sides of one contact in one phase, and what they have cost so far.
class PyramidCosts {
 public:
  PyramidCosts(int phase, int contact, const std::vector<FrictionEdge>& added) {
    const std::vector<int> edges = FrictionDirections(contact, added);
    for (size_t e = 0; e < edges.size(); ++e) {
      const int to = e + 1 < edges.size() ? edges[e + 1] : FrictionEdge::kDirections;
      sums_.push_back({{phase, contact, {edges[e], to}, 0, 0}, Eigen::Vector2d::Zero()});
    }
  }

  void Add(double friction_coefficient, const IntervalPathRows::HeldForce& held) {
    const Eigen::Vector2d tangential = held.force.head<2>();
    const double pull = held.pull.norm(), size = tangential.norm();
    if (pull == 0 || size == 0) return;
    const double cost = friction_coefficient * held.force.z() * pull - held.pull.dot(tangential);
    const Eigen::Vector2d middle = held.pull / pull + tangential / size;
    if (!(cost > 0) || middle.norm() < 1) return;  // rounding of a force that vanishes
    const double step = AngleOf(middle) * FrictionEdge::kDirections / (2 * std::numbers::pi);
    auto place = sums_.rbegin();
    while (place->side.side.from > step) ++place;
    place->side.cost += cost;
    place->direction += cost * middle.normalized();
  }

  void AppendTo(double objective_scale, std::vector<FlatSide>* sides) const {
    for (const Sum& sum : sums_) {
      if (sum.side.cost == 0) continue;
      sides->push_back(sum.side);
      sides->back().cost /= objective_scale;
      sides->back().direction = AngleOf(sum.direction);
    }
  }

 private:
  struct Sum {
    FlatSide side;
    Eigen::Vector2d direction;
  };
  std::vector<Sum> sums_;  // by ascending direction, from 0
};

}  // namespace

std::vector<FlatSide> CollocationNlp::FlatSides(const double* x, const VectorX& row_multipliers) const {
  std::vector<FlatSide> sides;
  for (int p = 0; p < layout_.phases(); ++p) {
    std::map<int, PyramidCosts> pyramids;
    for (int contact : problem_.phases[p].active) {
      pyramids.emplace(contact, PyramidCosts(p, contact, added_.Edges(p)));
    }
    for (int k = layout_.first_interval(p); k < layout_.first_interval(p + 1); ++k) {
      const double* lambda = row_multipliers.data() + FirstRow(k) + blocks_[p]->FirstPathRow();
      for (const auto& held : blocks_[p]->path().HeldForces(x + layout_.node(k), lambda)) {
        pyramids.at(held.contact).Add(problem_.friction_coefficient, held);
      }
    }
    for (const auto& [contact, pyramid] : pyramids) pyramid.AppendTo(objective_scale_, &sides);
  }
  return sides;
}

}  // namespace rollgait
