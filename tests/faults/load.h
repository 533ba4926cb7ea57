#ifndef ROLLGAIT_TESTS_FAULTS_LOAD_H_
#define ROLLGAIT_TESTS_FAULTS_LOAD_H_

#include <grpcpp/grpcpp.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "rollgait/v1/gait_service.grpc.pb.h"

namespace rollgait::faults {

using Stub = v1::GaitService::Stub;

// A stub on a connection of its own that tries again soon and notices a silent peer within ten seconds.
std::unique_ptr<Stub> Connect(const std::string& address);
// The context of a call with a token.
std::unique_ptr<grpc::ClientContext> CallAs(const std::string& token, std::chrono::milliseconds at_most);

// What a load that lived through a fault found.
struct Verdict {
  int64_t acknowledged = 0;  // creates that were answered
  int64_t succeeded = 0, dead_letters = 0;
  int64_t lost = 0;            // acknowledged and not there, not ended, or ended otherwise than its watcher was told
  int64_t duplicated = 0;      // solves beyond one a request, terminal events beyond one a solve
  int64_t gaps = 0;            // sequence numbers that were skipped or repeated, over all connections of a watcher
  int64_t changed = 0;         // events that read otherwise later
  int64_t retried = 0;         // attempts beyond the first
  int64_t reattached = 0;      // streams that broke and were taken up again
  int64_t unexpected = 0;      // answers that are neither success nor "try again"
  double longest_retry_s = 0;  // from the last sign of life of an attempt to the start of the next
  std::string first_problem;   // of what should be 0

  bool good() const { return lost + duplicated + gaps + changed + unexpected == 0 && acknowledged > 0; }
  // Of two loads, one after the other.
  void Add(const Verdict& other);
  std::string Text() const;
};

// Clients that create solves with request ids, watch each to its end and take streams up again where they broke. The
// solver is the tests' slow one: a hundred iterations a second.
class Load {
 public:
  struct Options {
    std::string address;
    int clients = 4;
    int iterations = 25;  // a solve
  };
  explicit Load(Options options);
  ~Load();

  int64_t finished() const { return finished_; }
  // Waits until every client has ended one more solve; throws std::runtime_error after two minutes.
  void AwaitRound();
  // Lets every client end what it has begun, then reads everything again and compares. Waits at most `at_most` for the
  // ends.
  Verdict Finish(std::chrono::seconds at_most = std::chrono::seconds(300));

 private:
  // What one watcher saw of one solve.
  struct Watched {
    std::string request_id, name;
    v1::SolveSpec spec;
    int64_t last = 0;
    std::map<int64_t, std::string> events;  // by number, without skipped_count
    int terminals = 0;
    v1::Solve finished;
  };

  void Client(int number);
  bool Create(Stub& stub, Watched* watched);
  bool WatchToEnd(Stub& stub, Watched* watched);
  void Take(const v1::SolveEvent& event, Watched* watched);
  void Compare(Stub& stub, const Watched& watched, Verdict* verdict);
  void Problem(int64_t Verdict::*count, const std::string& what);
  bool GivenUp() const { return std::chrono::steady_clock::now().time_since_epoch().count() > give_up_at_; }

  const Options options_;
  std::atomic<bool> stopping_{false};
  std::atomic<int64_t> give_up_at_{INT64_MAX};
  std::atomic<int64_t> finished_{0};
  std::mutex mutex_;  // protects what follows
  Verdict verdict_;
  std::vector<Watched> watched_;
  std::vector<int64_t> rounds_;  // solves that each client has ended
  std::vector<std::thread> threads_;
};

}  // namespace rollgait::faults

#endif  // ROLLGAIT_TESTS_FAULTS_LOAD_H_
