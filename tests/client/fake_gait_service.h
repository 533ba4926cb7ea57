// A GaitService in the test's process whose answers depend on the model's name, and which keeps what it was asked.
#ifndef ROLLGAIT_TESTS_CLIENT_FAKE_GAIT_SERVICE_H_
#define ROLLGAIT_TESTS_CLIENT_FAKE_GAIT_SERVICE_H_

#include <grpcpp/server.h>

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "rollgait/v1/gait_service.grpc.pb.h"

namespace rollgait::client {

// Model "planar" walks; "infeasible" and "crash" end as they say; "endless" runs until cancelled, with iterates;
// "refused" is INVALID_ARGUMENT with two violations; every other model is refused as unknown. The id of a solve is its
// model's name; one made by BatchCreateSolves has its slope in degrees behind it, "planar-5". Thread-safe.
class FakeGaitService : public v1::GaitService::Service {
 public:
  // Streams break after the event with this number, once for each entry: with UNAVAILABLE, and every other time with
  // CANCELLED, as gRPC ends what a stopping server has not taken up.
  void BreakAfter(std::multiset<int64_t> sequences);
  // Number of iterations of every solve made from now on; 5 if not called.
  void SetIterations(int iterations) { iterations_ = iterations; }

  // Batches of more requests are refused as too long.
  void SetBatchLimit(int requests) { batch_limit_ = requests; }
  // The next batch is refused once, to be sent again after `seconds`.
  void SetBusy(int seconds) { busy_s_ = seconds; }

  // False: as a server that does not know spell_out.
  void SetSpellsOut(bool spells_out) { spells_out_ = spells_out; }

  std::vector<v1::CreateSolveRequest> created() const;
  std::vector<v1::WatchSolveRequest> watched() const;
  std::vector<v1::WatchSolvesRequest> watched_together() const;
  std::vector<v1::ListSolvesRequest> listed() const;
  std::vector<std::string> cancelled() const;
  std::vector<std::string> deleted() const;

  grpc::Status CreateSolve(grpc::ServerContext*, const v1::CreateSolveRequest*, v1::Solve*) override;
  grpc::Status BatchCreateSolves(grpc::ServerContext*, const v1::BatchCreateSolvesRequest*,
                                 v1::BatchCreateSolvesResponse*) override;
  grpc::Status WatchSolves(grpc::ServerContext*, const v1::WatchSolvesRequest*,
                           grpc::ServerWriter<v1::SolveEvent>*) override;
  grpc::Status WatchSolve(grpc::ServerContext*, const v1::WatchSolveRequest*,
                          grpc::ServerWriter<v1::SolveEvent>*) override;
  grpc::Status GetSolve(grpc::ServerContext*, const v1::GetSolveRequest*, v1::Solve*) override;
  grpc::Status ListSolves(grpc::ServerContext*, const v1::ListSolvesRequest*, v1::ListSolvesResponse*) override;
  grpc::Status CancelSolve(grpc::ServerContext*, const v1::CancelSolveRequest*, v1::Solve*) override;
  grpc::Status SetSolvePriority(grpc::ServerContext*, const v1::SetSolvePriorityRequest*, v1::Solve*) override;
  grpc::Status DeleteSolve(grpc::ServerContext*, const v1::DeleteSolveRequest*, google::protobuf::Empty*) override;
  grpc::Status ListModels(grpc::ServerContext*, const v1::ListModelsRequest*, v1::ListModelsResponse*) override;
  grpc::Status GetModel(grpc::ServerContext*, const v1::GetModelRequest*, v1::Model*) override;
  grpc::Status CreateModel(grpc::ServerContext*, const v1::CreateModelRequest*, v1::Model*) override;
  grpc::Status DeleteModel(grpc::ServerContext*, const v1::DeleteModelRequest*, google::protobuf::Empty*) override;
  grpc::Status GetServerInfo(grpc::ServerContext*, const v1::GetServerInfoRequest*, v1::ServerInfo*) override;

 private:
  struct Record {
    v1::Solve solve;
    std::vector<v1::SolveEvent> events;
  };
  void Finish(Record& record, v1::SolveState state);
  // Of a running solve, as often as it is asked.
  static v1::SolveEvent IterateOf(const v1::WatchSolveRequest& request, int64_t sequence);
  // Under the lock.
  grpc::Status Create(const v1::CreateSolveRequest& request, const std::string& id, v1::Solve* solve);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  int iterations_ = 5;
  bool spells_out_ = true;
  int batch_limit_ = 256;
  int busy_s_ = 0;  // 0: not busy
  std::map<std::string, Record> records_;
  std::multiset<int64_t> breaks_;
  int broken_ = 0;
  std::vector<v1::ModelSummary> models_;  // stored
  std::vector<v1::CreateSolveRequest> created_;
  std::vector<v1::WatchSolveRequest> watched_;
  std::vector<v1::WatchSolvesRequest> watched_together_;
  std::vector<v1::ListSolvesRequest> listed_;
  std::map<std::string, std::string> by_request_id_;  // names of solves
  std::vector<std::string> cancelled_, deleted_;
};

// The service behind a loopback port.
class FakeServer {
 public:
  // Port 0: any free one.
  FakeServer(FakeGaitService& service, int port = 0);
  ~FakeServer();
  int port() const { return port_; }
  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

 private:
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

}  // namespace rollgait::client

#endif  // ROLLGAIT_TESTS_CLIENT_FAKE_GAIT_SERVICE_H_
