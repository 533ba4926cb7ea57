#ifndef ROLLGAIT_CORE_TRANSCRIPTION_POINT_WORKSPACE_H_
#define ROLLGAIT_CORE_TRANSCRIPTION_POINT_WORKSPACE_H_

#include <vector>

#include "core/ocp/problem.h"

namespace rollgait {

// Tree and contacts at the instant under evaluation; shared by all parts of a problem, so one problem serves one
// thread. with_dual: for the acceleration rows of schemes whose first point is a node.
struct PointWorkspace {
  PointWorkspace(const OptimalControlProblem& problem, bool with_dual) : tree(problem.model) {
    for (const ContactSurface& contact : problem.contacts) {
      contacts.emplace_back(problem.model, contact);
      if (with_dual) dual_contacts.emplace_back(problem.model, contact);
    }
  }
  TreeDynamics tree;
  std::vector<ContactDerivatives<double>> contacts;
  std::vector<ContactDerivatives<Dual>> dual_contacts;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_TRANSCRIPTION_POINT_WORKSPACE_H_
