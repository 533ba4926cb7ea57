#include "client/stream_breaks.h"

#include <algorithm>
#include <chrono>
#include <string>

namespace rollgait::client {

// A server killed while it writes can end the stream without a status, which gRPC reports as UNKNOWN "Stream removed";
// one that stops ends calls that it has not taken up as CANCELLED, which here is never our own doing.
bool IsBroken(const grpc::Status& status) {
  return status.ok() || status.error_code() == grpc::StatusCode::UNAVAILABLE ||
         status.error_code() == grpc::StatusCode::CANCELLED ||
         (status.error_code() == grpc::StatusCode::UNKNOWN &&
          status.error_message().find("Stream removed") != std::string::npos);
}

void ReadThroughBreaks(const StreamBreaks& breaks) {
  using Clock = std::chrono::steady_clock;
  auto last_heard = Clock::now();
  double wait_s = 0.1;
  bool first_failure = true;
  for (StreamEnd end = breaks.read(); !end.finished; end = breaks.read()) {
    if (end.heard) {
      last_heard = Clock::now();
      wait_s = 0.1;
      first_failure = true;
    }
    const double silent_s = std::chrono::duration<double>(Clock::now() - last_heard).count();
    if (silent_s >= breaks.reconnect_s) breaks.give_up(end.broken);
    if (first_failure) breaks.on_break();
    first_failure = false;
    breaks.wait(std::min(wait_s, std::max(breaks.reconnect_s - silent_s, 0.01)));
    wait_s = std::min(2.0 * wait_s, 3.0);
  }
}

}  // namespace rollgait::client
