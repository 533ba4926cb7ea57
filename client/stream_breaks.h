// Streams that break and are opened again.
#ifndef ROLLGAIT_CLIENT_STREAM_BREAKS_H_
#define ROLLGAIT_CLIENT_STREAM_BREAKS_H_

#include <grpcpp/support/status.h>

#include <functional>

namespace rollgait::client {

// How reading one stream ended.
struct StreamEnd {
  bool finished = false;  // all that is wanted has come
  bool heard = false;     // something has come
  grpc::Status broken;    // why, unless finished
};

// True for what a connection's or a server's death looks like from here, an early end among it.
bool IsBroken(const grpc::Status& status);

struct StreamBreaks {
  double reconnect_s = 60;                           // how long it is tried to re-attach; 0: not at all
  std::function<StreamEnd()> read;                   // reads one stream to its end
  std::function<void()> on_break;                    // at the first break after something was heard
  std::function<void(double seconds)> wait;          // before the next attempt
  std::function<void(const grpc::Status&)> give_up;  // throws
};

// Reads streams until one has finished.
void ReadThroughBreaks(const StreamBreaks& breaks);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_STREAM_BREAKS_H_
