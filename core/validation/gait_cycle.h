#ifndef ROLLGAIT_CORE_VALIDATION_GAIT_CYCLE_H_
#define ROLLGAIT_CORE_VALIDATION_GAIT_CYCLE_H_

#include <optional>
#include <string>
#include <vector>

#include "core/models/scene.h"
#include "core/trajectory/sampling.h"

namespace rollgait {

// The whole gait cycle, from heel strike to heel strike of one leg, the right one unless said otherwise. A half cycle
// is completed by its left/right mirror image. Refers to the scene and the trajectory it is made of, which must outlive
// it.
class GaitCycle {
 public:
  // The cycle of the leg on `side`. Empty if no contact of the scene is on that side, or if those of that side are
  // never off the ground or never on it. Contract: the trajectory fits the scene, and spans a full cycle if the scene
  // is not symmetric.
  static std::optional<GaitCycle> Of(const Scene& scene, const Trajectory& trajectory,
                                     BodySide side = BodySide::kRight);

  double start() const { return start_; }  // s, of the heel strike after the start of the trajectory, < duration()
  double duration() const { return duration_; }          // s
  double displacement() const { return displacement_; }  // m

  // A stretch of the cycle in which the same contacts are on the ground.
  struct Span {
    double begin, end;          // % of the cycle
    std::vector<int> contacts;  // indices into Scene::contacts, ascending
    bool right, left;           // a contact of that leg is among them
  };
  // From 0 to 100 % without gaps; neighbours differ in their contacts.
  const std::vector<Span>& spans() const { return spans_; }

  // The motion at `percent` ∈ [0, 100] of the cycle; at a border of phases (to rounding) that of the later one, at 100
  // the limit from the left. Forces: 3 · all contacts of the scene in its order, zero where there is no contact. The
  // forward joint of the base goes on through the cycle.
  MotionSample At(double percent) const;

  // True if the contact belongs to the right (left) leg.
  bool IsRight(int contact) const { return right_[contact]; }
  bool IsLeft(int contact) const { return left_[contact]; }

 private:
  // A phase of the trajectory, or its mirror image, at its place in the cycle.
  struct Piece {
    double start;  // s after the heel strike
    int phase;
    bool mirrored;
    double shift;  // m, added to the forward joint of the base
  };
  GaitCycle(const Scene& scene, const Trajectory& trajectory) : scene_(&scene), trajectory_(&trajectory) {}
  MotionSample Mirrored(const MotionSample& sample) const;
  double End(size_t piece) const { return piece + 1 < pieces_.size() ? pieces_[piece + 1].start : duration_; }
  std::vector<int> ContactsOf(const Piece& piece) const;
  bool Touches(const Piece& piece, const std::vector<bool>& leg) const;
  void BuildSpans();

  const Scene* scene_;
  const Trajectory* trajectory_;
  double start_ = 0, duration_ = 0, displacement_ = 0;
  std::vector<bool> right_, left_;
  std::vector<Piece> pieces_;  // in order, the first starts at 0
  std::vector<Span> spans_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_VALIDATION_GAIT_CYCLE_H_
