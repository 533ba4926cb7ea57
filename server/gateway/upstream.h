// Calls of rollgaitd.
#ifndef ROLLGAIT_SERVER_GATEWAY_UPSTREAM_H_
#define ROLLGAIT_SERVER_GATEWAY_UPSTREAM_H_

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace rollgait::server {

// How a call ended.
struct CallEnd {
  grpc::Status status;
  bool refused_at_door = false;  // the answer says what the door counts: server/base/door_headers.h
};

// A call with one request and any number of answers, each read when it is asked for: what is not asked for stays with
// rollgaitd, which bounds it.
class UpstreamCall {
 public:
  struct Request {
    std::string method;  // "/rollgait.v1.GaitService/GetSolve"
    std::string message;
    std::vector<std::pair<std::string, std::string>> metadata;
    std::chrono::milliseconds deadline{0};  // from now
  };
  // Called in threads of gRPC, one at a time; they must not block.
  struct Listener {
    std::function<void(std::string message)> on_message;  // after ReadNext()
    std::function<void(const CallEnd& end)> on_end;       // last, once
  };
  // Begins the call and asks for the first message. Values of metadata that are no printable ASCII end it at once, with
  // INVALID_ARGUMENT.
  static std::shared_ptr<UpstreamCall> Start(const std::shared_ptr<grpc::Channel>& channel, const Request& request,
                                             Listener listener);
  virtual ~UpstreamCall() = default;
  // After on_message, once for each message. Any thread.
  virtual void ReadNext() = 0;
  // Ends the call soon, on_end included. Any thread, any time, any number of times.
  virtual void Cancel() = 0;
};

// Where rollgaitd is: a loopback address or a unix socket, in plain text.
class Upstream {
 public:
  explicit Upstream(std::string server);
  // The connection that calls with one answer share.
  const std::shared_ptr<grpc::Channel>& channel() const { return channel_; }
  // A connection of its own, as a stream has that its client may leave unread.
  std::shared_ptr<grpc::Channel> MakeChannel() const;

 private:
  const std::string server_;
  std::shared_ptr<grpc::Channel> channel_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_GATEWAY_UPSTREAM_H_
