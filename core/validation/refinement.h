#ifndef ROLLGAIT_CORE_VALIDATION_REFINEMENT_H_
#define ROLLGAIT_CORE_VALIDATION_REFINEMENT_H_

#include <optional>
#include <vector>

namespace rollgait {

// An error measured on a mesh of step h.
struct MeshError {
  double step;   // > 0, s or any other unit
  double error;  // any unit
};

// What a sequence of meshes says about  error ≈ C · step^order.
struct ObservedOrder {
  double order;  // slope of the least-squares line through (log step, log error)
  std::vector<double>
      between_meshes;  // slopes between consecutive meshes, in the order given; one fewer than the meshes
};

// Needs at least two meshes with different steps and errors that are finite and > 0; otherwise there is no order to
// tell (an error of exactly zero, or an infinite one, says nothing of convergence) and the result is empty. Slopes
// between two meshes of equal step are refused in the same way.
std::optional<ObservedOrder> ObserveOrder(const std::vector<MeshError>& meshes);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_VALIDATION_REFINEMENT_H_
