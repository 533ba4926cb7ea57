// What fails around the server: disk, clocks, network, descriptors.
#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "tests/faults/faults.h"
#include "tests/server/store/small_disk.h"

namespace rollgait::faults {
namespace {

// The wall clock of programs that preload the tests' clock, as seconds beside the true one.
class WallClock {
 public:
  WallClock() { Set(0); }
  std::string path() const { return directory_.path() + "/offset"; }
  void Set(int64_t offset_s) const {
    const int fd = open(path().c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
    if (fd < 0 || pwrite(fd, &offset_s, sizeof offset_s, 0) != sizeof offset_s)
      throw std::runtime_error("no clock file");
    close(fd);
  }

 private:
  server::TemporaryDirectory directory_;
};

// A client that asks for new work until it is refused, and takes back what it was given.
class Asker {
 public:
  explicit Asker(const std::string& address) : stub_(Connect(address)) {}

  // Returns what the refusal said.
  std::string AskUntilRefused() {
    grpc::Status status;
    Await("a refusal of new work", [&] {
      grpc::ClientContext context;
      v1::CreateSolveRequest request;
      request.mutable_spec()->mutable_model()->set_name("planar");
      request.mutable_spec()->set_slope_rad(-1e-8 * ++asked_);
      v1::Solve solve;
      status = stub_->CreateSolve(&context, request, &solve);
      if (status.ok()) given_.push_back(solve.name());
      return !status.ok();
    });
    return "code " + std::to_string(status.error_code()) + ": " + status.error_message();
  }
  void TakeBack() {
    for (const std::string& name : given_) {
      v1::CancelSolveRequest cancel;
      cancel.set_name(name);
      v1::DeleteSolveRequest remove;
      remove.set_name(name);
      Await("the end of " + name, [&] {
        grpc::ClientContext cancelling, removing;
        v1::Solve solve;
        google::protobuf::Empty nothing;
        return stub_->CancelSolve(&cancelling, cancel, &solve).ok() &&
               stub_->DeleteSolve(&removing, remove, &nothing).ok();
      });
    }
    given_.clear();
  }

 private:
  const std::unique_ptr<Stub> stub_;
  int asked_ = 0;
  std::vector<std::string> given_;
};

bool Command(const std::string& command) { return std::system((command + " 2>/dev/null").c_str()) == 0; }

// A network namespace with a wire to ours.
class SecondHost {
 public:
  SecondHost() : id_(std::to_string(getpid() % 100'000)), net_("198.18." + std::to_string(getpid() % 250)) {
    made_ = Command("ip netns add rollgait-" + id_) &&
            Command("ip link add rg" + id_ + "a type veth peer name rg" + id_ + "b netns rollgait-" + id_) &&
            Command("ip addr add " + net_ + ".1/24 dev rg" + id_ + "a") && Wire(true) &&
            Command(Inside() + "ip addr add " + address() + "/24 dev rg" + id_ + "b") &&
            Command(Inside() + "ip link set rg" + id_ + "b up") && Command(Inside() + "ip link set lo up");
  }
  SecondHost(const SecondHost&) = delete;
  SecondHost& operator=(const SecondHost&) = delete;
  ~SecondHost() {
    Command("ip link del rg" + id_ + "a");
    Command("ip netns del rollgait-" + id_);
  }
  bool made() const { return made_; }
  std::string address() const { return net_ + ".2"; }
  std::vector<std::string> Launcher() const { return {"ip", "netns", "exec", "rollgait-" + id_}; }
  bool Wire(bool connected) const { return Command("ip link set rg" + id_ + "a " + (connected ? "up" : "down")); }

 private:
  std::string Inside() const { return "ip netns exec rollgait-" + id_ + " "; }
  const std::string id_, net_;
  bool made_ = false;
};

// Connections that say nothing, until their end.
class IdleConnections {
 public:
  IdleConnections(const std::string& address, int count) {
    sockaddr_in peer{};
    peer.sin_family = AF_INET;
    peer.sin_port = htons(static_cast<uint16_t>(std::stoi(address.substr(address.rfind(':') + 1))));
    inet_pton(AF_INET, "127.0.0.1", &peer.sin_addr);
    for (int i = 0; i < count; ++i) {
      const int fd = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
      if (fd < 0) throw std::runtime_error("this process has too few descriptors for the flood");
      fds_.push_back(fd);
      if (connect(fd, reinterpret_cast<const sockaddr*>(&peer), sizeof peer) != 0 && errno != EINPROGRESS) return;
    }
  }
  IdleConnections(const IdleConnections&) = delete;
  IdleConnections& operator=(const IdleConnections&) = delete;
  ~IdleConnections() {
    for (const int fd : fds_) close(fd);
  }

 private:
  std::vector<int> fds_;
};

}  // namespace

FaultReport FillDisk(const FaultOptions& options) {
  FaultReport report{"disk full × " + std::to_string(options.count), "refuses new work, goes on reading, loses nothing",
                     "", false, ""};
  const server::SmallDisk disk(24);
  report.skipped = disk.reason().empty() ? "" : "a small file system cannot be mounted: " + disk.reason();
  if (!report.skipped.empty()) return report;
  server::Daemon::Options daemon;
  daemon.data_dir = disk.path() + "/data";
  daemon.flags = {"--reserve-mb", "2"};
  FaultyServer server(daemon);
  Load load({server.address()});
  Asker asker(server.address());
  std::string refusal;
  int64_t unreadable = 0;
  for (int i = 0; i < options.count; ++i) {
    load.AwaitRound();
    disk.Fill();
    refusal = asker.AskUntilRefused();
    grpc::ClientContext context;
    v1::ListSolvesResponse page;
    unreadable += Connect(server.address())->ListSolves(&context, {}, &page).ok() ? 0 : 1;
    disk.Empty();
    asker.TakeBack();
    load.AwaitRound();
  }
  const Verdict verdict = load.Finish();
  report.measured =
      "refused with \"" + refusal + "\", " + std::to_string(unreadable) + " failed reads; " + verdict.Text();
  report.good = verdict.good() && unreadable == 0;
  return report;
}

FaultReport JumpClocks(const FaultOptions& options) {
  const WallClock clock;
  server::Daemon::Options daemon;
  daemon.launcher = {"env", std::string("LD_PRELOAD=") + CLOCK_PRELOAD, "ROLLGAIT_TEST_CLOCK=" + clock.path()};
  FaultyServer server(daemon);
  Load load({server.address()});
  constexpr int64_t kOffsets[] = {3600, -3600, 86400 * 30, -86400 * 365, 0};
  for (int i = 0; i < options.count; ++i) {
    clock.Set(kOffsets[i % std::size(kOffsets)]);
    load.AwaitRound();
  }
  const Verdict verdict = load.Finish();
  FaultReport report{"wall clock jumps by hours to a year × " + std::to_string(options.count),
                     "leases do not notice: no attempt is lost", verdict.Text(), false, ""};
  report.good = verdict.good() && verdict.retried == 0 && verdict.reattached == 0;
  return report;
}

FaultReport CutNetwork(const FaultOptions& options) {
  FaultReport report{"network cut × " + std::to_string(options.count), "watchers go on after it; nothing lost", "",
                     false, ""};
  const SecondHost host;
  if (!host.made()) report.skipped = "a network namespace cannot be made (needs root and iproute2)";
  if (!report.skipped.empty()) return report;
  server::Daemon::Options daemon;
  daemon.launcher = host.Launcher();
  daemon.listen = host.address() + ":0";
  daemon.flags = {"--insecure-listen", "--without-door"};
  FaultyServer server(daemon);
  Load load({server.address()});
  constexpr int kSeconds[] = {2, 40, 8};  // the second is longer than keepalive waits
  for (int i = 0; i < options.count; ++i) {
    load.AwaitRound();
    host.Wire(false);
    std::this_thread::sleep_for(std::chrono::seconds(kSeconds[i % std::size(kSeconds)]));
    host.Wire(true);
    load.AwaitRound();
  }
  const Verdict verdict = load.Finish();
  report.measured = verdict.Text();
  report.good = verdict.good();
  return report;
}

FaultReport FloodDescriptors(const FaultOptions& options) {
  constexpr int kConnections = 600;
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  limit.rlim_cur = limit.rlim_max;
  setrlimit(RLIMIT_NOFILE, &limit);
  server::Daemon::Options daemon;
  daemon.launcher = {"prlimit", "--nofile=200:200"};
  FaultyServer server(daemon);
  Load load({server.address()});
  double longest = 0;
  for (int i = 0; i < options.count; ++i) {
    load.AwaitRound();
    {
      const IdleConnections flood(server.address(), kConnections);
      std::this_thread::sleep_for(std::chrono::seconds(2));  // the server takes what it takes
    }
    longest = std::max(longest, SecondsToAnswer(server.address()));
  }
  const Verdict verdict = load.Finish();
  FaultReport report{"600 idle connections at nofile=200 × " + std::to_string(options.count),
                     "serving ≤ 10 s after it ends",
                     "serving after at most " + SecondsText(longest) + "; " + verdict.Text(), false, ""};
  report.good = verdict.good() && (!options.judge_times || longest <= 10);
  return report;
}

}  // namespace rollgait::faults
