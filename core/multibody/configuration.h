#ifndef ROLLGAIT_CORE_MULTIBODY_CONFIGURATION_H_
#define ROLLGAIT_CORE_MULTIBODY_CONFIGURATION_H_

#include "core/base/types.h"
#include "core/multibody/model.h"

namespace rollgait {

// The set of configurations of a tree: R for a joint with one degree of freedom, S³ × R³ for a free joint. Tangent
// vectors have nv entries; those of a free joint are the link's rotation and translation in link axes, as its
// velocities.

// q̇ (nq) at (q, v). Of a quaternion: q̇ = ½ q ⊗ (0, ω), which keeps |q| along the exact flow, so that an integration in
// R⁴ leaves the sphere by its own error only, and a projection back onto it (NormalizeQuaternions) at most doubles the
// error of a step and keeps its order (Hairer, Lubich, Wanner, Geometric Numerical Integration, IV.4).
void PositionRate(const Model& model, const VectorX& q, const VectorX& v, VectorX* rate);

// q ⊕ δ: the configuration reached by moving along δ (nv) for unit time; rotations by the exponential map.
VectorX Retract(const Model& model, const VectorX& q, const VectorX& delta);

// Scales every quaternion to unit norm. Returns the largest | |q| − 1 | found.
double NormalizeQuaternions(const Model& model, VectorX* q);

// Zero everywhere, free joints with the identity rotation.
VectorX NeutralConfiguration(const Model& model);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MULTIBODY_CONFIGURATION_H_
