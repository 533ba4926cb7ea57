#ifndef ROLLGAIT_CORE_MODELS_SEGMENT_TABLE_H_
#define ROLLGAIT_CORE_MODELS_SEGMENT_TABLE_H_

#include <array>
#include <string>
#include <vector>

#include "core/models/body_selection.h"
#include "core/models/rigid_body.h"
#include "core/multibody/joint_role.h"

namespace rollgait {

enum class Segment { kHeadNeck, kTorso, kPelvis, kUpperArm, kForearm, kHand, kThigh, kShank, kFoot };

inline constexpr int kSegments = 9;
// Name on the wire: "head_neck", "torso", "pelvis", "upper_arm", "forearm", "hand", "thigh", "shank", "foot".
const char* SegmentName(Segment segment);

// Whether a segment has a left and a right: all but head, torso and pelvis.
constexpr bool IsPaired(Segment segment) {
  return segment != Segment::kHeadNeck && segment != Segment::kTorso && segment != Segment::kPelvis;
}

// From the segment axes of the ISB, X forward, Y up, Z to the right, to ours: x forward, y left, z up.
inline Vector3 FromIsb(const Vector3& isb) { return Vector3(isb.x(), -isb.z(), isb.y()); }

// By how much each segment, in the order of Segment, is longer than the table has it; all 1: proportional to stature.
using SegmentScales = std::array<double, kSegments>;
inline constexpr SegmentScales kTableScales = {1, 1, 1, 1, 1, 1, 1, 1, 1};

// The body segments of a person by sex, stature and mass: lengths, joint centres and mass properties. Axes of every
// segment in the upright reference posture (arms and legs straight down): x forward, y left, z up; the table's are
// X anterior, Y up, Z right. Lengths are proportional to stature, masses to body mass, inertias to mass · length². A
// segment with a scale of its own keeps its mass and the shape of its mass distribution. The height of the ankle
// follows from the stature alone, so the standing height changes with the segments. Immutable value.
class SegmentTable {
 public:
  // Contract: stature (m), mass (kg) and scales finite and > 0.
  SegmentTable(Sex sex, double stature, double mass, const SegmentScales& scales = kTableScales);

  // Mass properties about the segment's proximal joint centre: head and neck, torso: cervical; pelvis: lumbar; upper
  // arm: shoulder; forearm: elbow; hand: wrist; thigh: hip; shank: knee; foot: ankle. The masses of the whole body
  // (limbs counted twice) add up to the body mass. Head, torso and pelvis are made symmetric about the sagittal plane.
  // Contract: kMidline for these three, kLeft or kRight for the others.
  RigidBody Body(Segment segment, BodySide side) const;

  double mass() const { return mass_; }        // kg, of the body
  double stature() const { return stature_; }  // m, by the request, whatever the segments make of it

  // Distance in m from the proximal joint centre to the distal one (head: to the vertex; hand: to the middle of the
  // metacarpal heads 2 and 5; foot: to the middle of the metatarsal heads 1 and 5; pelvis: to the middle of the hips).
  double Length(Segment segment) const;

  // m. From the lumbar joint to the middle of the hip joints.
  Vector3 LumbarToHips() const;
  // m. Half the distance of the hip joint centres.
  double HalfHipWidth() const;
  // m. From the cervical joint to the left (y > 0) or right shoulder joint.
  Vector3 CervicalToShoulder(BodySide side) const;
  // m. Ankle joint above the sole in the reference posture: what the other lengths leave of the stature.
  double AnkleHeight() const;
  // m. Hip joint above the sole with straight leg.
  double LegLength() const;
  // m. Heel to tip of the second toe: what a person calls the length of the foot.
  double FootLength() const;
  // m. Heel behind the ankle joint, along the foot.
  double HeelToAnkle() const;
  // m, from the ankle joint. The metatarsal heads (middle of 1 and 5), about which the toes bend.
  Vector3 AnkleToToes() const;

  // Where the numbers come from and what was changed, one line each.
  static std::vector<std::string> Sources();

 private:
  double Scaled(double length_mm) const;
  // As the table has it, without the segment's own scale.
  double TableLength(Segment segment) const;
  double Scale(Segment segment) const { return scales_[static_cast<size_t>(segment)]; }

  Sex sex_;
  double length_scale_;  // stature / mean stature of the table
  double stature_;       // m
  double mass_;          // kg
  SegmentScales scales_;
};

// Mean stature of the table's sample, m, and the body mass that a request without one gets, kg.
double DefaultStature(Sex sex);
double DefaultMass(Sex sex);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_SEGMENT_TABLE_H_
