#ifndef ROLLGAIT_SERVER_RPC_WATCH_STREAM_H_
#define ROLLGAIT_SERVER_RPC_WATCH_STREAM_H_

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "rollgait/v1/gait_service.pb.h"
#include "server/access/gatekeeper.h"
#include "server/base/executor.h"
#include "server/service/watch_hub.h"

namespace rollgait::server {

// One event stream to one client: of WatchSolve and WatchSolves, and of RunSolve after its solve was made. One write is
// in flight at a time. A reader is slow if a write took longer than `slow_write`; what waits for it then is merged
// (MergeIterations). Reactions do not block: everything that may touch the store runs on the executor.
class WatchStream : public grpc::ServerWriteReactor<v1::SolveEvent>, public std::enable_shared_from_this<WatchStream> {
 public:
  struct Target {
    std::vector<WatchPosition> solves;  // one or several
    int64_t bytes = 0;  // of the longest solve: the stream is refused before that is read if there is no room for it
  };
  // Finds or makes what is to be watched. Runs on the executor.
  using Find = std::function<Outcome<Target>(const Caller&)>;
  struct Plan {
    std::optional<Error> refusal;                                // the whole answer, if there is one
    std::function<Outcome<std::shared_ptr<Admission>>()> admit;  // runs on the executor
    Find find;
    // Called on the executor, with the first of the target, if the client has gone before the terminal event was
    // written. May be empty.
    std::function<void(const Caller&, const std::string& id)> on_disconnect;
    std::string lane;  // of the executor
  };

  // Starts the stream; it deletes itself when gRPC is done with it. Executor and hub outlive it.
  static WatchStream* Start(Executor& executor, WatchHub& hub, std::chrono::milliseconds slow_write,
                            grpc::CallbackServerContext* context, Plan plan);

  void OnWriteDone(bool ok) override;
  void OnCancel() override;
  void OnDone() override;

 private:
  WatchStream(Executor& executor, WatchHub& hub, std::chrono::milliseconds slow_write,
              grpc::CallbackServerContext* context, Plan plan)
      : executor_(executor), hub_(hub), slow_write_(slow_write), context_(context), plan_(std::move(plan)) {}

  void Prepare();
  // Admits the call and finds what it watches.
  Outcome<Target> FindTarget();
  Outcome<std::unique_ptr<EventSource>> Open(const std::vector<WatchPosition>& solves);
  // The right to watch is gone: ends the stream, also one whose reader does not read.
  void Withdraw(const Error& error);
  // Asks the executor for a pump unless one is asked for or a write is in flight, whose end will pump.
  void Wake();
  // Takes what is new and starts a write or ends the stream. On the executor.
  void Pump();
  // Ends the stream instead if its reader holds too many unread answers: what waits for the first event to be read is
  // held too.
  void Send(WatchBatch batch);
  void StartNextWrite();
  // Ends the stream once; later calls do nothing. Needs the lock.
  void End(const grpc::Status& status);
  void EndAsDisconnected();

  Executor& executor_;
  WatchHub& hub_;
  const std::chrono::milliseconds slow_write_;
  grpc::CallbackServerContext* const context_;
  const Plan plan_;
  std::shared_ptr<WatchStream> self_;  // until OnDone: gRPC holds a plain pointer

  std::mutex mutex_;  // protects what follows; watch_ is used by the one pump at a time only
  std::unique_ptr<EventSource> watch_;
  std::shared_ptr<Admission> admission_;
  std::optional<Error> withdrawn_;
  std::string id_;
  std::deque<EventPtr> waiting_;  // the first one is being written
  std::chrono::steady_clock::time_point write_start_;
  bool slow_ = false;
  bool pumping_ = true;  // a pump is posted or runs; true until prepared
  bool again_ = false;   // woken meanwhile
  bool last_batch_ = false;
  bool cancelled_ = false;
  bool ended_ = false;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_RPC_WATCH_STREAM_H_
