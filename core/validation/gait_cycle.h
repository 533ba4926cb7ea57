#ifndef ROLLGAIT_CORE_VALIDATION_GAIT_CYCLE_H_
#define ROLLGAIT_CORE_VALIDATION_GAIT_CYCLE_H_

#include <optional>
#include <string>
#include <vector>

#include "core/models/scene.h"
#include "core/trajectory/sampling.h"

namespace rollgait {

// The whole gait cycle, from heel strike to heel strike of the right leg. A half cycle is completed by its left/right
// mirror image. Refers to the scene and the trajectory it is made of, which must outlive it.
class GaitCycle {
 public:
  // Empty if the model has no right leg (a joint hip_r, knee_r or ankle_r), or if that leg is never off the ground or
  // never on it. Contract: the trajectory fits the scene, and spans a full cycle if the scene is not symmetric.
  static std::optional<GaitCycle> Of(const Scene& scene, const Trajectory& trajectory);

  double duration() const { return duration_; }          // s
  double displacement() const { return displacement_; }  // m

  // The motion at `percent` ∈ [0, 100] of the cycle; at a border of phases (to rounding) that of the later one, at 100 the limit from
  // the left. Forces: 3 · all contacts of the scene in its order, zero where there is no contact. base_x goes on through
  // the cycle.
  MotionSample At(double percent) const;

  // Shares of the cycle, 0 … 1.
  double Stance() const;         // a contact of the right leg is on the ground
  double DoubleSupport() const;  // contacts of both legs are

  // % of the cycle; empty if it does not happen. The first after 0 %.
  std::optional<double> OppositeToeOff() const;
  std::optional<double> OppositeHeelStrike() const;
  std::optional<double> ToeOff() const;

  // True if the contact belongs to the right leg.
  bool IsRight(int contact) const { return right_[contact]; }

 private:
  // A phase of the trajectory, or its mirror image, at its place in the cycle.
  struct Piece {
    double start;   // s after the heel strike
    int phase;
    bool mirrored;
    double shift;   // m, added to base_x
    bool right, left;  // on the ground
  };
  GaitCycle(const Scene& scene, const Trajectory& trajectory) : scene_(&scene), trajectory_(&trajectory) {}
  MotionSample Mirrored(const MotionSample& sample) const;
  double End(size_t piece) const { return piece + 1 < pieces_.size() ? pieces_[piece + 1].start : duration_; }
  // Start of the first piece, in %, where `leg` becomes `on`.
  std::optional<double> FirstChange(bool Piece::*leg, bool on) const;

  const Scene* scene_;
  const Trajectory* trajectory_;
  double duration_ = 0, displacement_ = 0;
  std::vector<bool> right_;
  std::vector<Piece> pieces_;  // in order, the first starts at 0
};

// Index of the joint of the right leg by its name without side ("hip", "knee", "ankle"), -1 if there is none.
int RightJoint(const Model& model, const std::string& name);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_VALIDATION_GAIT_CYCLE_H_
