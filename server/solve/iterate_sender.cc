#include "server/solve/iterate_sender.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/base/iterate_files.h"
#include "server/convert/iterate_convert.h"

namespace rollgait::server {
namespace {

bool IsFinite(const CoarseMotion& motion) {
  return std::isfinite(motion.duration) && std::isfinite(motion.displacement) &&
         std::all_of(motion.phases.begin(), motion.phases.end(),
                     [](const CoarseMotion::Phase& phase) { return phase.positions.allFinite(); });
}

}  // namespace

bool IterateSender::Wants() { return !last_ || std::chrono::steady_clock::now() - *last_ >= pause_; }

void IterateSender::Take(const IterationInfo& iteration, const CoarseMotion& motion) {
  last_ = std::chrono::steady_clock::now();
  if (!IsFinite(motion)) return;
  v1::Iterate encoded = EncodeIterate(iteration, motion, scene_);
  if (encoded.ByteSizeLong() <= kMaxIterateBytes) send_(std::move(encoded));
}

}  // namespace rollgait::server
