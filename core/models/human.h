#ifndef ROLLGAIT_CORE_MODELS_HUMAN_H_
#define ROLLGAIT_CORE_MODELS_HUMAN_H_

#include <string>
#include <vector>

#include "core/contact/body_surface.h"
#include "core/contact/contact_surface.h"
#include "core/models/foot.h"
#include "core/multibody/model.h"

namespace rollgait {

struct HumanOptions {
  FootShape feet = FootShape::kOneEllipsoid;
  JointRanges ranges = JointRanges::kAnatomical;
  bool toes = false;  // a toe joint in each foot; contract: with feet of two ellipsoids only
  FootOutlines left_foot = {}, right_foot = {};
};

struct HumanBody {
  Model model;
  std::vector<ContactSurface> contacts;  // all of the left foot, then all of the right one
  std::vector<BodySurface> bodies;       // limb_bodies.h
  std::vector<BodyPair> pairs;
};

// The whole human: 29 degrees of freedom, 23 of them actuated; 31 and 25 with toe joints. All zero: standing straight,
// arms hanging, palms to the thighs, the hips' middle at the world's origin. World: x forward, y left, z up, the
// ground's normal. Joints in this order, rad or m, with what is positive:
//   base_x, base_y, base_z           middle of the hip joint centres
//   base_yaw, base_roll, base_pitch  of the pelvis: turn to the left, lean to the right, lean forward
//   hip, hip_adduction, hip_rotation of the left leg (_l), then the right (_r): flexion, adduction, internal rotation
//   knee, ankle, ankle_inversion     of the same leg: flexion, dorsiflexion, inversion
//   toe                              of the same leg, if there is one: dorsiflexion
//   trunk_flexion, trunk_bending, trunk_rotation  of the torso on the pelvis: forward, to the right, to the left
//   shoulder, shoulder_adduction, shoulder_rotation, elbow  _l, then _r: flexion, adduction, internal rotation, flexion
// A joint of several degrees of freedom is the chain of these with massless links between, in this order. Its chart is
// regular while the middle angle stays off ±90°: the pelvis' roll (at most ±60°, kLargestBaseRoll), hip and shoulder
// adduction (at most -45..30° and -80..45°), trunk bending (at most ±35°). Walking stays below 15° in all of them but
// the shoulder. Left and right joints mirror each other with sign 1; base_y, yaw, roll, trunk bending and rotation
// mirror themselves with sign -1. Contacts: left_foot and right_foot, or left_heel, left_forefoot, right_heel,
// right_forefoot. Bodies: the contacts under their own names, with feet of two ellipsoids left_instep, too; left_shank,
// left_thigh, left_forearm (with the hand), and the same of the right. Standing straight, none overlap. Contract: the
// table's person.
HumanBody Human(const SegmentTable& table, const HumanOptions& options);
// The same with limbs of other lengths on the right. Joints and contacts name the mirror images that they would have if
// sides were alike. Contract: tables of one person that differ in the scales of paired segments alone.
HumanBody Human(const SegmentTable& left, const SegmentTable& right, const HumanOptions& options);

// Where a segment is on the human: the joint whose link carries it, and its proximal joint centre on that link, m.
struct SegmentPlace {
  std::string joint;
  Vector3 origin = Vector3::Zero();
};
// Contract: the side that the segment has (SegmentTable::Body), and the table of that side.
SegmentPlace PlaceOf(Segment segment, BodySide side, const SegmentTable& table);

// Where the numbers of the body come from. `symmetric`: left and right are mirror images.
std::vector<std::string> HumanSources(bool symmetric);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_HUMAN_H_
