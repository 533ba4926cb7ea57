#include "server/convert/iterate_convert.h"

#include "server/convert/result_convert.h"

namespace rollgait::server {

v1::Iterate EncodeIterate(const IterationInfo& iteration, const CoarseMotion& motion, const Scene& scene) {
  v1::Iterate encoded;
  encoded.set_index(iteration.index);
  encoded.set_mesh(iteration.mesh);
  for (const Joint& joint : scene.model.joints()) encoded.add_joint_names(joint.name);
  encoded.set_cycle(EncodeCycle(motion.cycle));
  encoded.set_duration_s(motion.duration);
  encoded.set_displacement_m(motion.displacement);
  for (const CoarseMotion::Phase& phase : motion.phases) {
    v1::Iterate::Phase& part = *encoded.add_phases();
    for (const int contact : phase.contacts) part.add_contacts(scene.contacts[contact].name);
    part.set_start_s(phase.start);
    part.set_duration_s(phase.duration);
    for (const double time : phase.times) part.add_times_s(static_cast<float>(time));
    // One column a time, column-major, becomes one row a time, row-major: the order stays.
    for (const double position : phase.positions.reshaped()) part.add_positions(static_cast<float>(position));
  }
  return encoded;
}

}  // namespace rollgait::server
