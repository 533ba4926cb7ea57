#ifndef ROLLGAIT_CORE_CONTACT_CONTACT_DERIVATIVES_H_
#define ROLLGAIT_CORE_CONTACT_CONTACT_DERIVATIVES_H_

#include <vector>

#include "core/base/dual.h"
#include "core/contact/contact_surface.h"
#include "core/multibody/tree_dynamics.h"

namespace rollgait {

// First and second derivatives of one contact of a tree with the plane z = 0, along the joints on the path from the
// world to the link that carries the surface. Everything comes from the contact point p(q) (the lowest point of the
// surface) and the bilinear form
//   β(q; y, u) = y · (velocity of the material point at p under the joint velocities u) = yᵀ J(q) u,
// whose derivatives give rolling (u = v, y = multipliers), generalised forces (u = λ, y = force) and, with T = Dual
// along (v, a), the acceleration of rolling. Indices k, m count joints on the path, root first; vectors are in world
// axes. Source: contact-math 5, 6; eqs (2.3), (2.10), (3.5). No allocation after construction; one object a thread.
template <typename T>
class ContactDerivatives {
 public:
  using Vec3 = Eigen::Matrix<T, 3, 1>;
  using Vec6 = Eigen::Matrix<T, 6, 1>;
  using Mat3 = Eigen::Matrix<T, 3, 3>;

  // β's dependence on one field of joint velocities u.
  struct Field {
    std::vector<Vec6> from;      // ΔU_k: twist of the link relative to the parent of joint k
    std::vector<Vec3> gradient;  // ∂(J u)/∂q_k
  };

  ContactDerivatives(const Model& model, const ContactSurface& contact);

  int path_size() const { return static_cast<int>(path_.size()); }
  const std::vector<int>& path() const { return path_; }

  // Reads poses and axes of the tree (UpdateKinematics at least). For T = Dual the direction is q̇ = v of the tree.
  void Update(const TreeDynamics& tree);
  // Adds what second derivatives need, after Update.
  void UpdateSecond();

  const Vec3& point() const { return point_; }                 // m, world
  const Vec3& nu() const { return nu_; }                       // outward normal at p in surface axes
  Vec3 JacobianColumn(int k) const { return At(axis_[k]); }    // column k of J
  const Vec3& PointDerivative(int k) const { return dp_[k]; }  // ∂p/∂q_k
  const Vec3& PointSecond(int m, int k) const { return ddp_[m <= k ? k * path_size() + m : m * path_size() + k]; }
  // ∂(J_k)/∂q_m, after Update.
  Vec3 JacobianDerivative(int m, int k) const;

  // Fills field for the velocities u, one per joint on the path.
  void ComputeField(const T* u, Field* field) const;
  Vec3 Velocity(const Field& field) const { return At(field.from[0]); }
  // ∂²(yᵀ J u)/∂q_m∂q_k, after UpdateSecond.
  T ContractedSecond(const Field& field, const Vec3& y, int m, int k) const;

  // Contact point on the surface in principal axes, x(ν), with its derivatives; for touch-down and lift-off points.
  const Vec3& surface_point() const { return surface_point_; }
  Vec3 SurfacePointDerivative(int k) const { return hessian_ * turn_[k]; }
  Vec3 SurfacePointSecond(int m, int k) const;

  Field MakeField() const;

 private:
  Vec3 At(const Vec6& motion) const {
    return motion.template tail<3>() + Vec3(motion.template head<3>()).cross(point_);
  }
  Vec3 Angular(int k) const { return axis_[k].template head<3>(); }
  Vec3 ThirdApply(const Vec3& u, const Vec3& y) const;  // T[u] y in surface axes

  ContactSurface contact_;
  std::vector<int> path_;
  std::vector<Vec6> axis_;
  std::vector<Vec3> dp_, delta_, turn_;  // ∂p/∂q_k, its part along the surface, Rᵀ(θ_k × n)
  std::vector<Vec3> ddp_;
  Mat3 rotation_;
  Vec3 point_, nu_, surface_point_;
  Mat3 hessian_;
  Mat3 third_[3];  // T[e_j]
  SupportJet jet_;
};

extern template class ContactDerivatives<double>;
extern template class ContactDerivatives<Dual>;

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_CONTACT_CONTACT_DERIVATIVES_H_
