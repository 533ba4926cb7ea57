#ifndef ROLLGAIT_SERVER_SOLVE_ITERATE_SENDER_H_
#define ROLLGAIT_SERVER_SOLVE_ITERATE_SENDER_H_

#include <chrono>
#include <functional>
#include <optional>

#include "core/gait/gait_spec.h"
#include "core/gait/iterate_sink.h"
#include "rollgait/v1/iterate.pb.h"

namespace rollgait::server {

// Sends the first iterate of a search, and then one when `pause` has passed since the last. One that is not finite or
// too long (kMaxIterateBytes) is left out. One thread; refers to the scene.
class IterateSender : public IterateSink {
 public:
  IterateSender(const Scene& scene, std::chrono::milliseconds pause, std::function<void(v1::Iterate)> send)
      : scene_(scene), pause_(pause), send_(std::move(send)) {}

  bool Wants() override;
  void Take(const IterationInfo& iteration, const CoarseMotion& motion) override;

 private:
  const Scene& scene_;
  const std::chrono::milliseconds pause_;
  const std::function<void(v1::Iterate)> send_;
  std::optional<std::chrono::steady_clock::time_point> last_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_SOLVE_ITERATE_SENDER_H_
