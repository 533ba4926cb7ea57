#ifndef ROLLGAIT_CORE_MODELS_REDUCTION_H_
#define ROLLGAIT_CORE_MODELS_REDUCTION_H_

#include <map>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/contact/body_surface.h"
#include "core/contact/contact_surface.h"
#include "core/multibody/model.h"

namespace rollgait {

// A tree with some joints fixed: a smaller tree in which each link is lumped with the links fixed to it. No joint
// without motion and no row without meaning is left: the mass matrix, the bias force and the kinematics are those rows
// and columns of the full tree, at the fixed positions and at rest, that belong to the joints that still move.
struct ModelReduction {
  // Where a link of the full tree is in the reduced one.
  struct Place {
    int joint = -1;                      // whose link carries it; -1: it stands still in the world
    Matrix3 R_KL = Matrix3::Identity();  // axes of the link -> axes of the link (or world) that carries it
    Vector3 p_KL = Vector3::Zero();      // m, origin of the link in it
  };
  Model model;
  std::vector<int> kept;      // index in the full tree of each joint of the reduced one
  std::vector<Place> places;  // one per joint of the full tree
  // True if the mirror image of the fixed joints is themselves. Otherwise the body has no left/right symmetry, and
  // every joint of the reduced tree names itself, with sign 1, as its mirror joint.
  bool symmetric = true;
};

// Fixes joints, by name, at positions in rad or m. What is fixed to the world leaves the tree with its mass. Any model
// without free joints among the named ones. Violations name `locked_joints_rad["NAME"]`: no such joint, a free joint, a
// number that is not finite; or `locked_joints_rad`: nothing would be left.
Result<ModelReduction> ReduceModel(const Model& model, const std::map<std::string, double>& locked);

// A contact of the full tree on the reduced one. Contract: its link moves.
ContactSurface ReduceContact(const ContactSurface& contact, const ModelReduction& reduction);
// The same for a body.
BodySurface ReduceBody(const BodySurface& body, const ModelReduction& reduction);
// The pairs whose bodies are on different links of the reduced tree: the others keep their distance for ever.
std::vector<BodyPair> ReducePairs(const std::vector<BodyPair>& pairs, const std::vector<BodySurface>& reduced_bodies);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_REDUCTION_H_
