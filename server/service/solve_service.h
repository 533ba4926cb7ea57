#ifndef ROLLGAIT_SERVER_SERVICE_SOLVE_SERVICE_H_
#define ROLLGAIT_SERVER_SERVICE_SOLVE_SERVICE_H_

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rollgait/v1/gait_service.pb.h"
#include "server/access/caller.h"
#include "server/base/digest.h"
#include "server/base/outcome.h"
#include "server/service/full_queue.h"
#include "server/service/gait_knowledge.h"
#include "server/service/model_service.h"
#include "server/service/solve_message.h"
#include "server/service/warm_start_search.h"
#include "server/service/watch_hub.h"
#include "server/store/disk_room.h"
#include "server/store/solve_store.h"

namespace rollgait::server {

struct ServiceOptions {
  std::string version;
  std::string solver_build;        // as in results
  std::string solver_fingerprint;  // differs whenever the solver's program does; part of every solve key
  int solver_slots = 1;
  int max_queued = 1000;
  bool reuse_results = true;  // false: every request is solved, equal ones too
  std::string store_name = "sqlite";
  DiskRoom store_disk;                             // none: ServerInfo says nothing of it
  std::function<std::string()> new_id = RandomId;  // ids of solves, each once
};

// The use cases, one method an RPC; what the errors mean is in gait_service.proto. Requests are refused with every
// violation found, before anything is stored. A solve belongs to its creator's tenant: for others it does not exist,
// and neither their results nor their warm starts come from it. Scopes are not looked at here. Any thread may call;
// every call may block on the store.
class SolveService {
 public:
  // `announce(id)` is called after a solve was created or cancelled: the agent and watchers want to look. The
  // stores outlive it.
  SolveService(SolveStore& store, ModelStore& models, GaitKnowledge knowledge, ServiceOptions options,
               std::function<void(const std::string& id)> announce);

  Outcome<v1::Solve> CreateSolve(const Caller& caller, const v1::CreateSolveRequest& request);
  // Refuses the first request that is wrong, with its index in the paths; answers without results. `attached`, unless
  // null, is raised by the number of solves that had been made before.
  Outcome<v1::BatchCreateSolvesResponse> BatchCreateSolves(const Caller& caller,
                                                           const v1::BatchCreateSolvesRequest& request,
                                                           int* attached = nullptr);
  // Asks for room before it reads: `hold` is told about how many bytes the answer has, and its error is the answer.
  Outcome<SolveBytes> GetSolve(const Caller& caller, const v1::GetSolveRequest& request,
                               const std::function<Outcome<Done>(int64_t bytes)>& hold);
  Outcome<v1::ListSolvesResponse> ListSolves(const Caller& caller, const v1::ListSolvesRequest& request);
  Outcome<v1::Solve> CancelSolve(const Caller& caller, const v1::CancelSolveRequest& request);
  Outcome<v1::Solve> SetSolvePriority(const Caller& caller, const v1::SetSolvePriorityRequest& request);
  Outcome<google::protobuf::Empty> DeleteSolve(const Caller& caller, const v1::DeleteSolveRequest& request);
  Outcome<v1::ServerInfo> GetServerInfo(const Caller& caller, const v1::GetServerInfoRequest& request);
  // How long a solve is that the caller may see; kNotFound, also for another tenant's unless the caller administers.
  Outcome<SolveExtent> ExtentFor(const Caller& caller, const std::string& id);
  // Where WatchSolves begins, at most kMostAtOnce places, and the length of the longest of these solves.
  struct Watched {
    std::vector<WatchPosition> positions;
    int64_t longest_bytes = 0;
  };
  Outcome<Watched> FindWatched(const Caller& caller, const v1::WatchSolvesRequest& request);
  static constexpr int kMostAtOnce = 256;
  // The id in the name of such a solve.
  Outcome<std::string> FindFor(const Caller& caller, const std::string& name);

  ModelService& models() { return models_; }

 private:
  // What a good spec starts from, and its key, which is empty if results are not reused.
  struct Checked {
    std::optional<FoundWarmStart> warm_start;
    std::string key;
  };
  // CreateSolve of a request that names no stored model.
  Outcome<v1::Solve> CreateResolved(const Caller& caller, const v1::CreateSolveRequest& request);
  // The same as it goes into the store, with all that can be wrong with it but its length.
  Outcome<NewSolve> MakeNew(const Caller& caller, const v1::CreateSolveRequest& request);
  // Of one of several; `bytes` counts what all of them take.
  Outcome<NewSolve> MakeOneOf(const Caller& caller, const v1::CreateSolveRequest& request, int64_t* bytes);
  Outcome<std::vector<WatchPosition>> FindLabelled(const Caller& caller, const v1::WatchSolvesRequest& request);
  // Tells of a new solve.
  void Announce(const CreatedSolve& created);
  // Creates it in the store, unless a queue was full a moment ago and it would need a place there.
  Outcome<CreatedSolve> Store(const NewSolve& solve);
  Outcome<Checked> CheckSpec(const Caller& caller, const v1::SolveSpec& spec, bool has_spec);

  SolveStore& store_;
  const GaitKnowledge knowledge_;
  ModelService models_;  // asks knowledge_
  const ServiceOptions options_;
  const std::function<void(const std::string& id)> announce_;
  FullQueue full_queue_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_SERVICE_SOLVE_SERVICE_H_
