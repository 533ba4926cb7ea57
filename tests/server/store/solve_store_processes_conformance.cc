// Processes that work on one store, and one of them dies.
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <set>
#include <vector>

#include "tests/server/store/store_bench.h"

namespace rollgait::server {
namespace {

constexpr size_t kSolves = 40;

// What a process tells of a solve that the store has acknowledged: so long that its pipe holds no second one, and
// neither process runs ahead of the test.
struct Acknowledgement {
  int number = -1;
  char rest[PIPE_BUF - sizeof(int)] = {};
};

struct Worker {
  pid_t pid = 0;
  int acknowledged = -1;

  // The next number; -1: it has gone.
  int Next() const {
    Acknowledgement next;
    return read(acknowledged, &next, sizeof next) == sizeof next ? next.number : -1;
  }
};

[[noreturn]] void Work(SolveStore& store, const std::string& owner, int out) {
  while (true) {
    const auto claimed = store.ClaimNext(owner, std::chrono::hours(1));
    if (!claimed.ok() || !claimed.value().has_value()) _exit(claimed.ok() ? 0 : 1);
    const Lease& lease = claimed.value()->lease;
    Acknowledgement done;
    done.number = std::stoi(lease.solve_id.substr(1));
    if (!store.AppendEvents(lease, {IterationEvent(0), IterationEvent(1)}).ok()) _exit(2);
    if (!store.Finish(lease, {IterationEvent(2)}, kAnswer).ok()) _exit(3);
    if (write(out, &done, sizeof done) != sizeof done) _exit(4);
  }
}

Worker Start(StoreBench& bench, const std::string& owner) {
  std::array<int, 2> ends;
  EXPECT_EQ(pipe(ends.data()), 0);
  EXPECT_GE(fcntl(ends[1], F_SETPIPE_SZ, PIPE_BUF), PIPE_BUF);
  const pid_t pid = fork();
  if (pid == 0) {
    const std::unique_ptr<SolveStore> store = bench.OpenAgain();
    Work(*store, owner, ends[1]);
  }
  close(ends[1]);
  return {pid, ends[0]};
}

TEST_P(SolveStoreConformance, KillOfAProcessLosesNothingItWasToldIsStored) {
  StoreBench bench(GetParam());
  for (size_t i = 0; i < kSolves; ++i) bench.Add(Numbered("s", i));
  bench.Close();
  const Worker victim = Start(bench, "victim"), survivor = Start(bench, "survivor");
  std::multiset<int> acknowledged;
  for (int i = 0; i < 3; ++i) {
    acknowledged.insert(victim.Next());
    acknowledged.insert(survivor.Next());
  }
  kill(victim.pid, SIGKILL);
  for (int number; (number = victim.Next()) >= 0;) acknowledged.insert(number);
  for (int number; (number = survivor.Next()) >= 0;) acknowledged.insert(number);
  int status = 0;
  ASSERT_EQ(waitpid(victim.pid, nullptr, 0), victim.pid);
  ASSERT_EQ(waitpid(survivor.pid, &status, 0), survivor.pid);
  EXPECT_EQ(status, 0);
  close(victim.acknowledged);
  close(survivor.acknowledged);
  bench.Restart();
  // At most one was in the victim's hands.
  const size_t orphans = bench.store().ReclaimOwner("victim").value().size();
  EXPECT_LE(orphans, 1u);
  if (orphans == 1) {
    EXPECT_TRUE(bench.store().Finish(bench.Claim(), {}, kAnswer).ok());
  }
  EXPECT_EQ(acknowledged.count(-1), 0u);
  for (const int number : acknowledged) EXPECT_EQ(acknowledged.count(number), 1u) << "done twice: " << number;
  for (size_t i = 0; i < kSolves; ++i) {
    const SolveRecord record = bench.Get(Numbered("s", i));
    EXPECT_EQ(record.state, SolveState::kSucceeded);
    EXPECT_EQ(record.result, "the result");
    ExpectDense(bench.Events(record.id));
    if (acknowledged.count(static_cast<int>(i)) == 1) {
      EXPECT_EQ(record.attempts, 1);
      EXPECT_EQ(record.last_sequence, 6);
    }
  }
}

TEST_P(SolveStoreConformance, AnEventThatIsHeldIsNotAppendedAgain) {
  StoreBench bench(GetParam());
  bench.Add("a");
  bench.Add("b");
  const Lease a = bench.Claim(), b = bench.Claim();
  std::vector<StoredEvent> events = {IterationEvent(0), IterationEvent(1)};
  events[0].sequence = 3;
  events[1].sequence = 4;
  ASSERT_TRUE(bench.store().AppendEvents(a, events).ok());
  events.push_back(IterationEvent(2));
  events[2].sequence = 5;
  // The answer of the first call was lost, so it is made again, with what has come since.
  EXPECT_EQ(bench.store().AppendEvents(a, events).value().last_sequence, 5);
  Lease lost = b;
  lost.epoch += 1;
  const auto outcomes = bench.store().AppendAll({{a, events}, {lost, events}, {b, {IterationEvent(0)}}}).value();
  ASSERT_EQ(outcomes.size(), 3u);
  EXPECT_EQ(outcomes[0].value().last_sequence, 5);
  EXPECT_EQ(outcomes[1].error().code, ErrorCode::kLeaseLost);
  EXPECT_EQ(outcomes[2].value().last_sequence, 3);
  const std::vector<StoredEvent> stored = bench.Events("a");
  ASSERT_EQ(stored.size(), 5u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(Parsed(stored[static_cast<size_t>(i) + 2]).iteration().index(), i);
}

}  // namespace
}  // namespace rollgait::server
