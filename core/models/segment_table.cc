#include "core/models/segment_table.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/check.h"

namespace rollgait {
namespace {

// One row of the table, as printed, for the right side. Mass in % of body mass; centre of mass and radii of gyration in
// % of the segment length, in X anterior, Y up, Z right; a negative product radius stands for a negative tensor entry.
struct Row {
  Segment segment;
  double length_mm;
  double mass;
  double com[3];
  double radii[6];  // xx, yy, zz, xy, xz, yz
};

using Rows = std::array<Row, kSegments>;

// Dumas, Cheze, Verriest 2007, J Biomech 40:543-553, head and neck from its corrigendum (40:1651); feet as corrected in
// Dumas, Wojtusch 2018 (ankle to the middle of the metatarsal heads 1 and 5). Lengths of the Young 1983 sample.
constexpr Rows kFemale = {{
    {Segment::kHeadNeck, 243, 6.7, {1.6, 57.5, 0.1}, {29, 23, 30, -4, 1, 0}},
    {Segment::kTorso, 429, 30.4, {-1.6, -43.6, -0.6}, {29, 27, 29, 22, 5, -5}},
    {Segment::kPelvis, 107, 14.6, {-0.9, -23.2, 0.2}, {91, 100, 79, -34, -1, -1}},
    {Segment::kUpperArm, 243, 2.2, {-7.3, -45.4, -2.8}, {33, 17, 33, 3, -5, 14}},
    {Segment::kForearm, 247, 1.3, {2.1, -41.1, 1.9}, {26, 14, 25, 10, 4, -13}},
    {Segment::kHand, 71, 0.5, {7.7, -76.8, 4.8}, {63, 43, 58, 29, 23, -28}},
    {Segment::kThigh, 379, 14.6, {-7.7, -37.7, 0.9}, {31, 19, 32, 7, -2, -7}},
    {Segment::kShank, 388, 4.5, {-4.9, -40.4, 3.1}, {28, 10, 28, 2, 1, 6}},
    {Segment::kFoot, 117, 1.0, {38.2, -30.9, 5.5}, {24, 51, 50, -15, 9, -5}},
}};
// The same for the McConville 1980 sample.
constexpr Rows kMale = {{
    {Segment::kHeadNeck, 277, 6.7, {2.0, 53.6, 0.1}, {28, 21, 30, -7, -2, 3}},
    {Segment::kTorso, 477, 33.3, {-3.6, -42.0, -0.2}, {27, 25, 28, 18, 2, -4}},
    {Segment::kPelvis, 94, 14.2, {2.8, -28.0, -0.6}, {101, 106, 95, -25, -12, -8}},
    {Segment::kUpperArm, 271, 2.4, {1.7, -45.2, -2.6}, {31, 14, 32, 6, 5, 2}},
    {Segment::kForearm, 283, 1.7, {1.0, -41.7, 1.4}, {28, 11, 27, 3, 2, -8}},
    {Segment::kHand, 80, 0.6, {8.2, -83.9, 7.4}, {61, 38, 56, 22, 15, -20}},
    {Segment::kThigh, 432, 12.3, {-4.1, -42.9, 3.3}, {29, 15, 30, 7, -2, -7}},
    {Segment::kShank, 433, 4.8, {-4.8, -41.0, 0.7}, {28, 10, 28, -4, -2, 5}},
    {Segment::kFoot, 139, 1.2, {50.2, -19.9, 3.4}, {22, 49, 48, 17, -11, 0}},
}};

// What else is known of the two samples, mm.
struct Sample {
  double stature, hip_forward, hip_down, half_hip_width, foot_length;
};
constexpr Sample kFemaleSample = {1610, 54, 93, 88, 238};
constexpr Sample kMaleSample = {1774, 56, 75, 81, 271};

// Heel behind the ankle as a fraction of the foot length. The table gives the foot's centre of mass from the ankle and,
// in its alternative row, from the heel along the same axis: 48.3 mm (0.178) male, 60.9 mm (0.256) female. The mean is
// used.
constexpr double kHeelFraction = 0.217;
// Height and half distance of the shoulder joints as fractions of stature (Drillis and Contini, after Winter 2009).
constexpr double kShoulderHeight = 0.818;
constexpr double kHalfShoulderWidth = 0.129;
// Metatarsal heads over the sole, as a fraction of the ankle height: 24 mm of 80 mm, an assumption. With the table's
// distance from the ankle it puts them at 0.69 (male) and 0.65 (female) of the foot length.
constexpr double kToeJointHeight = 0.3;

const Rows& RowsOf(Sex sex) { return sex == Sex::kFemale ? kFemale : kMale; }
const Sample& SampleOf(Sex sex) { return sex == Sex::kFemale ? kFemaleSample : kMaleSample; }

const Row& RowOf(Sex sex, Segment segment) {
  const Row& row = RowsOf(sex)[static_cast<size_t>(segment)];
  ROLLGAIT_CHECK(row.segment == segment);
  return row;
}

// Sum of the mass column over the whole body: 99.9 female, 100.2 male, by rounding in the paper.
double MassSum(Sex sex) {
  double sum = 0;
  for (const Row& row : RowsOf(sex)) sum += row.mass * (IsPaired(row.segment) ? 2 : 1);
  return sum;
}

// Nearest tensor (Frobenius norm) with I1 + I2 >= I3 and the same principal axes. The female torso of the table misses
// it.
Matrix3 NearestRealisable(const Matrix3& inertia) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(inertia);
  Vector3 moments = solver.eigenvalues();  // ascending
  const double excess = moments(2) - moments(0) - moments(1);
  if (excess <= 0) return inertia;
  moments += Vector3(excess, excess, -excess) / 3;
  return solver.eigenvectors() * moments.asDiagonal() * solver.eigenvectors().transpose();
}

}  // namespace

const char* SegmentName(Segment segment) {
  constexpr const char* kNames[kSegments] = {"head_neck", "torso", "pelvis", "upper_arm", "forearm",
                                             "hand",      "thigh", "shank",  "foot"};
  return kNames[static_cast<size_t>(segment)];
}

SegmentTable::SegmentTable(Sex sex, double stature, double mass, const SegmentScales& scales)
    : sex_(sex), length_scale_(stature / DefaultStature(sex)), stature_(stature), mass_(mass), scales_(scales) {
  ROLLGAIT_CHECK(std::isfinite(stature) && stature > 0 && std::isfinite(mass) && mass > 0);
  for (double scale : scales_) ROLLGAIT_CHECK(std::isfinite(scale) && scale > 0);
}

double SegmentTable::Scaled(double length_mm) const { return length_mm * 1e-3 * length_scale_; }

RigidBody SegmentTable::Body(Segment segment, BodySide side) const {
  ROLLGAIT_CHECK(IsPaired(segment) == (side != BodySide::kMidline));
  const Row& row = RowOf(sex_, segment);
  const double mass = mass_ * row.mass / MassSum(sex_);
  // Mirroring changes the sign of everything odd in Z; a body symmetric about the sagittal plane has none of it.
  const double z_sign = side == BodySide::kRight ? 1 : side == BodySide::kLeft ? -1 : 0;
  const double length = Length(segment);
  const Vector3 com = Vector3(row.com[0], row.com[1], z_sign * row.com[2]) / 100 * length;
  const auto entry = [&](int i) { return mass * length * length * row.radii[i] * std::abs(row.radii[i]) / 1e4; };
  Matrix3 inertia;
  inertia << entry(0), entry(3), z_sign * entry(4),  //
      entry(3), entry(1), z_sign * entry(5),         //
      z_sign * entry(4), z_sign * entry(5), entry(2);
  Matrix3 from_table;
  from_table << FromIsb(Vector3::UnitX()), FromIsb(Vector3::UnitY()), FromIsb(Vector3::UnitZ());
  return {mass, FromIsb(com), from_table * NearestRealisable(inertia) * from_table.transpose()};
}

double SegmentTable::TableLength(Segment segment) const { return Scaled(RowOf(sex_, segment).length_mm); }

double SegmentTable::Length(Segment segment) const { return TableLength(segment) * Scale(segment); }

Vector3 SegmentTable::LumbarToHips() const {
  return Vector3(Scaled(SampleOf(sex_).hip_forward), 0, -Scaled(SampleOf(sex_).hip_down)) * Scale(Segment::kPelvis);
}

double SegmentTable::HalfHipWidth() const { return Scaled(SampleOf(sex_).half_hip_width) * Scale(Segment::kPelvis); }

Vector3 SegmentTable::CervicalToShoulder(BodySide side) const {
  ROLLGAIT_CHECK(side != BodySide::kMidline);
  const double cervical_height = stature_ - TableLength(Segment::kHeadNeck);
  const double down = cervical_height - kShoulderHeight * stature_;
  return Vector3(0, (side == BodySide::kLeft ? 1 : -1) * kHalfShoulderWidth * stature_, -down * Scale(Segment::kTorso));
}

double SegmentTable::AnkleHeight() const {
  return stature_ - TableLength(Segment::kHeadNeck) - TableLength(Segment::kTorso) - Scaled(SampleOf(sex_).hip_down) -
         TableLength(Segment::kThigh) - TableLength(Segment::kShank);
}

double SegmentTable::LegLength() const { return Length(Segment::kThigh) + Length(Segment::kShank) + AnkleHeight(); }

double SegmentTable::FootLength() const { return Scaled(SampleOf(sex_).foot_length) * Scale(Segment::kFoot); }

double SegmentTable::HeelToAnkle() const { return kHeelFraction * FootLength(); }

Vector3 SegmentTable::AnkleToToes() const {
  const double down = (1 - kToeJointHeight) * AnkleHeight();
  return Vector3(std::sqrt(std::max(0.0, std::pow(Length(Segment::kFoot), 2) - down * down)), 0, -down);
}

std::vector<std::string> SegmentTable::Sources() {
  return {
      "Segment masses, centres of mass and inertias: Dumas, Cheze, Verriest 2007, J Biomech 40:543-553 (2007 table and "
      "corrigendum 40:1651); feet: Dumas, Wojtusch 2018; read in OpenMA (BSD-3) and HuMoD (BSD-3).",
      "Masses are renormalised: the printed percentages add up to 99.9 (female) and 100.2 (male).",
      "The female torso tensor of the table is that of no rigid body (I1 + I2 < I3); the nearest realisable tensor "
      "with "
      "the same axes is used. The sign of the female upper arm's yz product is disputed (OpenMA's is used).",
      "Segment lengths: means of the Young 1983 (female, 1.610 m) and McConville 1980 (male, 1.774 m) samples in Dumas "
      "2007, quoted from memory of the paper and not checked against a second source; proportional to stature.",
      "Joint centres of the pelvis from the lumbar joint: OpenMA lyonwholebodymodel.cpp (BSD-3). Ankle height: stature "
      "minus the other lengths (0.080 m male, 0.078 m female).",
      "Shoulder joints: 0.818 of stature high, 0.129 to the side (Drillis and Contini, after Winter 2009; from "
      "memory), in "
      "the fore-aft position of the cervical joint.",
      "Heel behind the ankle: 0.217 of the foot length, mean of both sexes' foot centre of mass measured from the "
      "ankle "
      "and from the heel (Dumas 2007).",
  };
}

double DefaultStature(Sex sex) { return SampleOf(sex).stature * 1e-3; }

double DefaultMass(Sex sex) { return sex == Sex::kFemale ? 62 : 75; }

}  // namespace rollgait
