#ifndef ROLLGAIT_SERVER_CONVERT_ITERATE_CONVERT_H_
#define ROLLGAIT_SERVER_CONVERT_ITERATE_CONVERT_H_

#include "core/gait/gait_spec.h"
#include "core/nlp/result.h"
#include "core/trajectory/coarse_motion.h"
#include "rollgait/v1/iterate.pb.h"

namespace rollgait::server {

// `motion` in the joints of the scene.
v1::Iterate EncodeIterate(const IterationInfo& iteration, const CoarseMotion& motion, const Scene& scene);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_CONVERT_ITERATE_CONVERT_H_
