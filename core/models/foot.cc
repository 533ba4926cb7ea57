#include "core/models/foot.h"

namespace rollgait {
namespace {

// Sole radius of curvature a²/c over leg length: human feet roll like such a wheel (Adamczyk, Collins, Kuo 2006).
constexpr double kRollingRadius = 0.3;
// Half foot breadth over foot length (101 of 270 mm, US Army male survey of 1988; from memory).
constexpr double kHalfFootBreadth = 0.187;
// Heel of a foot of two ellipsoids: half length and half breadth over foot length, radius of curvature over leg length.
constexpr double kHeelHalfLength = 0.15, kHeelHalfBreadth = 0.125, kHeelRadius = 0.05;
// Its forefoot: half length over foot length; it ends at the tip of the toes.
constexpr double kForefootHalfLength = 0.2;
// Toes: share of the mass of the foot. With a tenth or more, what remains of the female foot is no rigid body.
constexpr double kToesMass = 0.08;

// Half height of an ellipsoid of the given half length and sole radius.
double HalfHeight(double half_length, double radius) { return half_length * half_length / radius; }

Surface SurfaceOf(const Vector3& semi_axes, const std::optional<double>& exponent) {
  if (!exponent) return Ellipsoid(semi_axes);
  return SmoothSuperellipsoid(semi_axes, *exponent, *exponent, kFootSmoothing);
}

}  // namespace

std::vector<FootSurface> FootSurfaces(const SegmentTable& table, FootShape shape, const FootOutlines& outlines) {
  const double length = table.FootLength(), heel = -table.HeelToAnkle(), sole = -table.AnkleHeight();
  const double radius = kRollingRadius * table.LegLength();
  // `place`: x of the centre for a half length.
  const auto surface = [&](const std::string& name, FootPart part, double half_length, double half_breadth,
                           double sole_radius, auto place) {
    const auto given = outlines.find(name);
    const FootOutline outline = given != outlines.end() ? given->second : FootOutline{};
    const Vector3 semi_axes =
        outline.semi_axes.value_or(Vector3(half_length, half_breadth, HalfHeight(half_length, sole_radius)));
    return FootSurface{name,
                       part,
                       semi_axes,
                       SurfaceOf(semi_axes, outline.exponent),
                       Vector3(place(semi_axes.x()), 0, sole + semi_axes.z()),
                       part == FootPart::kToe};
  };
  if (shape == FootShape::kOneEllipsoid) {
    return {surface("foot", FootPart::kWhole, length / 2, kHalfFootBreadth * length, radius,
                    [&](double) { return heel + length / 2; })};
  }
  return {surface("heel", FootPart::kHeel, kHeelHalfLength * length, kHeelHalfBreadth * length,
                  kHeelRadius * table.LegLength(), [&](double a) { return heel + a; }),
          surface("forefoot", FootPart::kToe, kForefootHalfLength * length, kHalfFootBreadth * length, radius,
                  [&](double a) { return heel + length - a; })};
}

FootBodies SplitFoot(const SegmentTable& table, BodySide side) {
  const RigidBody whole = table.Body(Segment::kFoot, side);
  const Vector3 joint = table.AnkleToToes();
  const double half_length = (table.FootLength() - table.HeelToAnkle() - joint.x()) / 2;
  const double half_height = FootSurfaces(table, FootShape::kTwoEllipsoids)[1].semi_axes.z();
  const Vector3 squares = Vector3(half_length, kHalfFootBreadth * table.FootLength(), half_height).cwiseAbs2();
  RigidBody toes;
  toes.mass = kToesMass * whole.mass;
  toes.center_of_mass = Vector3(half_length, whole.center_of_mass.y(), half_height - table.AnkleHeight() - joint.z());
  toes.inertia = toes.mass / 5 * (squares.sum() * Vector3::Ones() - squares).asDiagonal();
  return {CutOff(whole, Shifted(toes, joint)), toes};
}

std::vector<std::string> FootSources() {
  return {
      "Feet: ellipsoids from heel to toe (a = half foot length) whose sole has the radius of curvature a²/c = 0.3 × "
      "leg "
      "length (Adamczyk, Collins, Kuo 2006, J Exp Biol 209:3953); bottom at the sole of the standing foot; half "
      "breadth "
      "0.187 × foot length (US Army survey 1988, male means, from memory).",
      "Feet of two ellipsoids (own choice of shape): heel of half length 0.15 and half breadth 0.125 × foot length "
      "with "
      "sole radius 0.05 × leg length, forefoot of half length 0.2 and half breadth 0.187 × foot length with sole "
      "radius "
      "0.3 × leg length.",
      "Feet of a request with an exponent (own choice of shape): superellipsoids of that exponent along and around "
      "their "
      "height, smoothed by 0.1 so that they have a curvature everywhere.",
      "Toe joint: at the middle of the metatarsal heads 1 and 5, at 0.3 of the ankle height (assumption). Toes: 0.08 "
      "of the "
      "mass of the foot (OpenSim's gait2392 has 0.14, from memory; with 0.1 or more the rest of the table's female "
      "foot is no "
      "rigid body), inertia of a solid ellipsoid from the joint to the tip; the rest of the foot is what remains.",
  };
}

}  // namespace rollgait
