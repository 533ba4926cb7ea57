// kill -9 of PostgreSQL's primary under load, and its synchronous standby takes over.
#include <algorithm>
#include <random>
#include <thread>

#include "tests/faults/faults.h"
#include "tests/support/postgres_cluster.h"

namespace rollgait::faults {
namespace {

// Takes a solve away that is none of the load's.
void Remove(Stub& stub, const std::string& name) {
  Await("the probe's solve to be deleted", [&] {
    grpc::ClientContext to_cancel, to_delete;
    v1::CancelSolveRequest cancel;
    cancel.set_name(name);
    v1::Solve solve;
    v1::DeleteSolveRequest request;
    request.set_name(name);
    google::protobuf::Empty nothing;
    return stub.CancelSolve(&to_cancel, cancel, &solve).ok() && stub.DeleteSolve(&to_delete, request, &nothing).ok();
  });
}

// Seconds from the promotion until the server has stored a new solve.
double SecondsToCreate(const std::string& address) {
  const auto start = std::chrono::steady_clock::now();
  const std::unique_ptr<Stub> stub = Connect(address);
  v1::Solve solve;
  Await("a solve to be created", [&] {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(2));
    v1::CreateSolveRequest request;
    request.set_request_id("after-failover");
    request.mutable_spec()->mutable_model()->set_name("planar");
    return stub->CreateSolve(&context, request, &solve).ok();
  });
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  Remove(*stub, solve.name());
  return seconds;
}

struct Round {
  Verdict verdict;
  double seconds = 0;
};

// Many short solves, so that the primary dies with creates, claims, events and ends in flight; `pause` after all
// clients have ended one.
Round FailOver(std::chrono::milliseconds pause) {
  PostgresCluster primary({.durable = true});
  PostgresCluster standby({.durable = true, .primary = &primary});
  primary.Execute("ALTER SYSTEM SET synchronous_standby_names = '*'");
  primary.Execute("SELECT pg_reload_conf()");
  Await("a synchronous standby",
        [&] { return primary.Execute("SELECT COUNT(*) FROM pg_stat_replication WHERE sync_state = 'sync'") == "1"; });
  server::Daemon::Options daemon;
  daemon.flags = {"--store", "postgresql://rollgait@/postgres?host=" + primary.directory() + "," + standby.directory()};
  FaultyServer server(daemon);
  Load load({.address = server.address(), .clients = 12, .iterations = 5});
  load.AwaitRound();
  std::this_thread::sleep_for(pause);
  primary.Kill();
  standby.Promote();
  Round round;
  round.seconds = SecondsToCreate(server.address());
  load.AwaitRound();
  round.verdict = load.Finish();
  return round;
}

}  // namespace

FaultReport FailOverPostgres(const FaultOptions& options) {
  FaultReport report{"PostgreSQL: kill -9 of the primary, standby promoted × " + std::to_string(options.count),
                     "0 acknowledged lost; serving ≤ 5 s after promotion", "", true, ""};
  double longest = 0;
  Verdict verdict;
  std::mt19937 random(options.seed);
  for (int i = 0; i < options.count; ++i) {
    const Round round = FailOver(std::chrono::milliseconds(std::uniform_int_distribution(500, 1500)(random)));
    longest = std::max(longest, round.seconds);
    verdict.Add(round.verdict);
    report.good = round.verdict.good();
    if (!report.good) break;
  }
  report.measured = verdict.Text() + "; serving " + SecondsText(longest) + " after promotion";
  if (options.judge_times) report.good = report.good && longest <= 5;
  return report;
}

}  // namespace rollgait::faults
