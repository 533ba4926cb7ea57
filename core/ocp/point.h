#ifndef ROLLGAIT_CORE_OCP_POINT_H_
#define ROLLGAIT_CORE_OCP_POINT_H_

#include <memory>
#include <vector>

#include "core/contact/contact_derivatives.h"
#include "core/multibody/tree_dynamics.h"

namespace rollgait {

// Where the variables of one instant sit in its vector z = (q, v, a, τ, f): n positions, velocities and accelerations,
// the efforts of the actuated joints, and the forces of the active contacts, contact by contact in their directions.
struct PointLayout {
  int n = 0;
  int efforts = 0;
  int forces = 0;
  int q() const { return 0; }
  int v() const { return n; }
  int a() const { return 2 * n; }
  int tau() const { return 3 * n; }
  int force() const { return 3 * n + efforts; }
  int size() const { return 3 * n + efforts + forces; }
};

// A contact that is active in a phase: its index in the problem, and its first force relative to PointLayout::force().
struct ActiveContact {
  int contact = 0;
  int offset = 0;
  std::vector<int> directions;
};

// What the functions of one instant share, evaluated once: the variables, the tree and the contacts at them.
struct PointContext {
  const double* z = nullptr;
  TreeDynamics* tree = nullptr;
  std::vector<ContactDerivatives<double>>* contacts = nullptr;  // one per contact of the problem
  std::vector<ContactDerivatives<Dual>>* dual_contacts = nullptr;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_POINT_H_
