#ifndef ROLLGAIT_BENCH_SERVICE_LOAD_TARGET_H_
#define ROLLGAIT_BENCH_SERVICE_LOAD_TARGET_H_

#include <grpcpp/grpcpp.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "rollgait/v1/gait_service.grpc.pb.h"
#include "tests/e2e/daemon.h"
#include "tests/server/store/temporary_directory.h"

namespace rollgait::load {

using Stub = v1::GaitService::Stub;

struct TargetOptions {
  std::string address;      // HOST:PORT of a running server; empty: one is started
  std::string tls_ca;       // file; empty: plain text to a running server
  std::string token_file;   // first line is the token for a running server; empty: none
  bool plain_text = false;  // the server that is started speaks no TLS and asks for no token
  int solver_slots = 2;
  std::string solver;              // path; empty: that of the build
  std::vector<std::string> flags;  // more of them, for the server that is started
};

// The server that is measured: a running one, or a rollgaitd of this build in a temporary directory, with a certificate
// and a token of its own, which ends with the target. Throws std::runtime_error with a sentence where there is none to
// talk to.
class Target {
 public:
  explicit Target(const TargetOptions& options);

  enum class Windows {
    kGrowing,  // gRPC probes the connection and lets its flow-control windows grow
    kFixed,    // 64 kB: what a reader does not take stays with the server soon
  };
  // A connection of its own.
  std::shared_ptr<grpc::Channel> Open(Windows windows = Windows::kGrowing) const;
  // A stub on such a one.
  std::unique_ptr<Stub> Connect(Windows windows = Windows::kGrowing) const;
  std::vector<std::unique_ptr<Stub>> Connect(int count, Windows windows = Windows::kGrowing) const;
  // Carries the token.
  void Authorize(grpc::ClientContext& context) const;
  // Resident memory of the server in bytes; 0 for a server that was not started here.
  int64_t ServerMemory() const;
  const std::string& address() const { return address_; }

 private:
  void Start(const TargetOptions& options);

  std::string address_;
  std::string token_;
  std::string authority_;  // whose certificates are trusted, PEM; empty: plain text
  std::shared_ptr<grpc::ChannelCredentials> credentials_;
  server::TemporaryDirectory directory_;
  std::unique_ptr<server::Daemon> daemon_;
};

// Keeps the slots busy with solves that take minutes (human29 from many starts); cancels them at the end.
class BusySlots {
 public:
  BusySlots(const Target& target, int slots);
  ~BusySlots();
  // False: a solve has ended and a core went idle; the measurement does not count.
  bool StillBusy();

 private:
  const Target& target_;
  std::unique_ptr<Stub> stub_;
  std::vector<std::string> names_;
};

// Samples the server's memory ten times a second while it lives.
class MemoryWatch {
 public:
  explicit MemoryWatch(const Target& target);
  ~MemoryWatch();
  // Ends the sampling. Mean of the last quarter minus that of the second, in bytes.
  int64_t Growth();
  int64_t Largest();

 private:
  void Stop();
  const Target& target_;
  std::atomic<bool> stopping_{false};
  std::vector<int64_t> samples_;
  std::thread thread_;
};

}  // namespace rollgait::load

#endif  // ROLLGAIT_BENCH_SERVICE_LOAD_TARGET_H_
