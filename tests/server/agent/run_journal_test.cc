// What one attempt leaves to the next. With the real solver: tests/e2e/outliving_test.cc.
#include "server/agent/run_journal.h"

#include <fstream>

#include "server/base/journal_limits.h"
#include "server/base/metrics.h"
#include "server/store/measured_store.h"
#include "tests/server/agent/agent_fixture.h"

namespace rollgait::server {
namespace {

using Record = wire::SolverMessage::Record;

Record Finished(int program, const std::string& bytes) {
  Record record;
  record.set_program(program);
  record.set_finished(bytes);
  return record;
}

Record Started(int program, const std::string& bytes) {
  Record record;
  record.set_program(program);
  record.set_started(bytes);
  return record;
}

v1::Iteration At(int mesh, int index) {
  v1::Iteration iteration;
  iteration.set_mesh(mesh);
  iteration.set_index(index);
  return iteration;
}

class RunJournalTest : public AgentFixture {
 protected:
  ClaimedSolve Claim() { return *store_->ClaimNext("owner", kLeaseDuration).value(); }
  void GiveBack(const ClaimedSolve& claimed, GiveBackReason reason) {
    ASSERT_TRUE(store_->GiveBack(claimed.lease, reason, "for the test").ok());
  }
  // The journal of a run that has taken up what there is.
  RunJournal Journal(const ClaimedSolve& claimed, const std::string& fingerprint = "ours") {
    return Journal(spool_, RunJournal::Elsewhere::kNowhere, claimed, fingerprint);
  }
  RunJournal Journal(const Spool& spool, RunJournal::Elsewhere elsewhere, const ClaimedSolve& claimed,
                     const std::string& fingerprint = "ours") {
    RunJournal journal(spool, *store_, elsewhere, claimed.lease, fingerprint);
    journal.TakeUp(claimed.record);
    return journal;
  }
  // The same on a machine with a spool of its own.
  RunJournal JournalElsewhere(const ClaimedSolve& claimed) {
    return Journal(other_spool_, RunJournal::Elsewhere::kInStore, claimed);
  }
  std::string PathOf(const ClaimedSolve& claimed) const {
    return directory_ + "/spool/" + claimed.lease.solve_id + "-" + std::to_string(claimed.lease.epoch) + ".journal";
  }
  // The first attempt: a program is finished, another under way; it reported iterations up to mesh 1, index 4.
  ClaimedSolve FirstAttempt() {
    Queue("unused");
    ClaimedSolve claimed = Claim();
    RunJournal journal = Journal(claimed);
    EXPECT_TRUE(journal.records().finished().empty());
    EXPECT_TRUE(journal.Take(Finished(0, "program 0")));
    EXPECT_TRUE(journal.Take(Started(1, "program 1")));
    journal.Save();
    std::vector<StoredEvent> events;
    for (int index = 0; index <= 4; ++index) {
      v1::SolveEvent event;
      *event.mutable_iteration() = At(1, index);
      events.push_back({0, EventKind::kIteration, event.SerializeAsString()});
    }
    EXPECT_TRUE(store_->AppendEvents(claimed.lease, events).ok());
    return claimed;
  }

  void SetUp() override {
    AgentFixture::SetUp();
    spool_ = Spool::Open(directory_ + "/spool").value();
    other_spool_ = Spool::Open(directory_ + "/other").value();
  }
  Spool spool_ = Spool::Open(std::filesystem::temp_directory_path().string()).value(), other_spool_ = spool_;
};

TEST_F(RunJournalTest, TheNextAttemptTakesUpTheRecordsAndKnowsWhatWasReported) {
  GiveBack(FirstAttempt(), GiveBackReason::kStopping);
  RunJournal journal = Journal(Claim());
  ASSERT_EQ(journal.records().finished_size(), 1);
  EXPECT_EQ(journal.records().finished(0), "program 0");
  EXPECT_EQ(journal.records().started(), "program 1");
  EXPECT_FALSE(journal.changed());
  EXPECT_TRUE(journal.HasReported(At(1, 3)));
  EXPECT_TRUE(journal.HasReported(At(1, 4)));
  EXPECT_FALSE(journal.HasReported(At(1, 5)));
  EXPECT_FALSE(journal.HasReported(At(0, 0))) << "what comes after a new iteration is new";
}

TEST_F(RunJournalTest, ASolveThatStartsAfreshReportsEverything) {
  GiveBack(FirstAttempt(), GiveBackReason::kStopping);
  RunJournal journal = Journal(Claim());
  wire::SolverMessage::Continuation continuation;
  continuation.set_ignored("the record of program 0 is of another program");
  journal.Take(continuation);
  EXPECT_FALSE(journal.HasReported(At(0, 0)));
  EXPECT_TRUE(journal.Take(Started(0, "anew"))) << "takes the place of all of program 0 and later";
  EXPECT_TRUE(journal.records().finished().empty());
  EXPECT_EQ(journal.records().started(), "anew");
}

TEST_F(RunJournalTest, AnotherSolversRecordsAreLeft) {
  GiveBack(FirstAttempt(), GiveBackReason::kStopping);
  RunJournal journal = Journal(Claim(), "theirs");
  EXPECT_TRUE(journal.records().finished().empty());
  EXPECT_FALSE(journal.HasReported(At(1, 3)));
}

TEST_F(RunJournalTest, ADamagedJournalIsRemoved) {
  const ClaimedSolve first = FirstAttempt();
  GiveBack(first, GiveBackReason::kStopping);
  std::ofstream(PathOf(first)) << "what is this?";
  EXPECT_TRUE(Journal(Claim()).records().finished().empty());
  EXPECT_FALSE(std::filesystem::exists(PathOf(first)));
}

// A solver that the records themselves bring down would end as a failure otherwise.
TEST_F(RunJournalTest, TheLastAttemptLeavesRecordsThatLedNoFurther) {
  GiveBack(FirstAttempt(), GiveBackReason::kCrashed);
  const ClaimedSolve second = Claim();
  EXPECT_EQ(Journal(second).records().finished_size(), 1);
  GiveBack(second, GiveBackReason::kCrashed);
  EXPECT_EQ(Journal(Claim()).records().finished_size(), 0);
}

TEST_F(RunJournalTest, TheLastAttemptTakesUpWhatTheSecondCameTo) {
  const ClaimedSolve first = FirstAttempt();
  GiveBack(first, GiveBackReason::kCrashed);
  const ClaimedSolve second = Claim();
  RunJournal journal = Journal(second);
  EXPECT_TRUE(journal.Take(Finished(1, "program 1, finished")));
  journal.Save();
  EXPECT_FALSE(std::filesystem::exists(PathOf(first))) << "the newer one takes its place";
  GiveBack(second, GiveBackReason::kCrashed);
  RunJournal third = Journal(Claim());
  EXPECT_EQ(third.records().finished_size(), 2);
  EXPECT_EQ(third.records().started(), "");
  third.Remove();
  EXPECT_TRUE(spool_.JournalOwners().empty());
}

// A solver that was killed before its request arrived has not failed on the records.
TEST_F(RunJournalTest, AnAttemptThatNeverBeganIsNoReasonToLeaveThem) {
  GiveBack(FirstAttempt(), GiveBackReason::kCrashed);
  const ClaimedSolve second = Claim();
  RunJournal journal = Journal(second);
  EXPECT_TRUE(journal.Take(Finished(1, "program 1, finished")));
  journal.Save();
  GiveBack(second, GiveBackReason::kCrashed);
  const ClaimedSolve third = Claim();
  EXPECT_EQ(Journal(third).records().finished_size(), 2);
  GiveBack(third, GiveBackReason::kNeverBegan);
  const ClaimedSolve fourth = Claim();
  EXPECT_EQ(Journal(fourth).records().finished_size(), 2);
  GiveBack(fourth, GiveBackReason::kStopping);
  EXPECT_EQ(Journal(Claim()).records().finished_size(), 2);
}

TEST_F(RunJournalTest, AnotherMachineTakesUpWhatIsInTheStore) {
  const ClaimedSolve first = FirstAttempt();
  {
    RunJournal journal = Journal(spool_, RunJournal::Elsewhere::kInStore, first);
    EXPECT_EQ(journal.Share(), RunJournal::kSharePause);
    EXPECT_FALSE(store_->ReadJournal(first.lease.solve_id).value()) << "there is nothing yet";
    EXPECT_TRUE(journal.Take(Started(0, "shared")));
    journal.Save();
    EXPECT_EQ(journal.Share(), RunJournal::kSharePause);
    EXPECT_TRUE(journal.Take(Started(0, "in the spool alone")));
    journal.Save();
  }
  GiveBack(first, GiveBackReason::kStopping);
  const ClaimedSolve second = Claim();
  RunJournal elsewhere = JournalElsewhere(second);
  EXPECT_EQ(elsewhere.records().started(), "shared");
  EXPECT_TRUE(elsewhere.HasReported(At(1, 4)));
  // Where the first ran, its own is as new: it is saved more often.
  RunJournal at_home = Journal(spool_, RunJournal::Elsewhere::kInStore, second);
  EXPECT_EQ(at_home.records().started(), "in the spool alone");
  // Not once the second has shared more.
  EXPECT_TRUE(elsewhere.Take(Started(0, "of the second")));
  elsewhere.Save();
  elsewhere.Share();
  GiveBack(second, GiveBackReason::kStopping);
  EXPECT_EQ(Journal(spool_, RunJournal::Elsewhere::kInStore, Claim()).records().started(), "of the second");
}

TEST_F(RunJournalTest, ARunningSolveIsSharedFromTimeToTime) {
  using std::chrono::milliseconds;
  const ClaimedSolve first = FirstAttempt();
  RunJournal journal = Journal(spool_, RunJournal::Elsewhere::kInStore, first);
  const std::chrono::steady_clock::time_point start{};
  const auto shared_at = [&](milliseconds time, const std::string& state) {
    EXPECT_TRUE(journal.Take(Started(0, state)));
    journal.Keep(start + time);
    const std::optional<StoredJournal> stored = store_->ReadJournal(first.lease.solve_id).value();
    return stored && stored->content.find(state) != std::string::npos;
  };
  constexpr milliseconds kPause = RunJournal::kSharePause, kInstant(1);
  EXPECT_FALSE(shared_at(milliseconds(0), "a solve that is soon over costs the store nothing"));
  EXPECT_FALSE(shared_at(kPause - kInstant, "not yet"));
  EXPECT_TRUE(shared_at(kPause, "now"));
  EXPECT_FALSE(shared_at(2 * kPause - kInstant, "not again"));
  EXPECT_TRUE(shared_at(2 * kPause, "again"));
}

// The solve is given back until the store takes it; what it has come to must not have got lost before.
TEST_F(RunJournalTest, WhatTheStoreDidNotTakeIsSharedNextTime) {
  class Away : public MeasuredStore {
   public:
    using MeasuredStore::MeasuredStore;
    Outcome<Done> PutJournal(const Lease& lease, const std::string& journal) override {
      if (away) return ::rollgait::server::Error{ErrorCode::kUnavailable, "away"};
      return MeasuredStore::PutJournal(lease, journal);
    }
    bool away = true;
  };
  const ClaimedSolve first = FirstAttempt();
  Metrics metrics("test", "0", "build");
  Away store(*store_, metrics);
  RunJournal journal(spool_, store, RunJournal::Elsewhere::kInStore, first.lease, "ours");
  EXPECT_TRUE(journal.Take(Started(0, "kept")));
  journal.Save();
  journal.Share();
  EXPECT_FALSE(store_->ReadJournal(first.lease.solve_id).value());
  store.away = false;
  journal.Save();
  journal.Share();
  EXPECT_TRUE(store_->ReadJournal(first.lease.solve_id).value());
}

TEST_F(RunJournalTest, AgentsThatShareTheSpoolPutNothingIntoTheStore) {
  const ClaimedSolve first = FirstAttempt();
  RunJournal journal = Journal(first);
  EXPECT_TRUE(journal.Take(Started(0, "here")));
  journal.Save();
  journal.Share();
  EXPECT_FALSE(store_->ReadJournal(first.lease.solve_id).value());
}

TEST_F(RunJournalTest, WhatIsLongIsSharedSeldom) {
  const ClaimedSolve first = FirstAttempt();
  RunJournal journal = Journal(spool_, RunJournal::Elsewhere::kInStore, first);
  EXPECT_TRUE(journal.Take(Started(0, std::string(10 * RunJournal::kBytesPerSecond, 'x'))));
  journal.Save();
  EXPECT_GE(journal.Share(), std::chrono::seconds(10));
  EXPECT_EQ(journal.Share(), RunJournal::kSharePause) << "it is there";
}

// Whatever it is, the solve starts from nothing.
TEST_F(RunJournalTest, WhatIsNoJournalInTheStoreIsLeft) {
  for (const char* content : {"what is this?", ""}) {
    const ClaimedSolve first = FirstAttempt();
    ASSERT_TRUE(store_->PutJournal(first.lease, content).ok());
    GiveBack(first, GiveBackReason::kStopping);
    const ClaimedSolve second = Claim();
    EXPECT_EQ(JournalElsewhere(second).records().finished_size(), 0);
    EXPECT_EQ(Journal(spool_, RunJournal::Elsewhere::kInStore, second).records().finished_size(), 1) << "its own stays";
    ASSERT_TRUE(store_->Finish(second.lease, {}, {SolveState::kCancelled, "", "", false}).ok());
  }
}

TEST_F(RunJournalTest, WhatASolverSendsIsBounded) {
  Queue("unused");
  RunJournal journal = Journal(Claim());
  EXPECT_FALSE(journal.Take(Started(-1, "no program")));
  const std::string large(kMaxJournalBytes / 3, 'x');
  for (int program = 0; program < 5; ++program) EXPECT_TRUE(journal.Take(Finished(program, large)));
  EXPECT_EQ(journal.records().finished_size(), 3) << "those that fit, in order";
  EXPECT_TRUE(journal.Take(Started(4, "after what was left out")));
  EXPECT_EQ(journal.records().started(), "");
  EXPECT_TRUE(journal.Take(Started(1000, "far off")));
  EXPECT_EQ(journal.records().finished_size(), 3);
}

TEST_F(RunJournalTest, AJournalThatIsTooLongIsNotRead) {
  const ClaimedSolve first = FirstAttempt();
  GiveBack(first, GiveBackReason::kStopping);
  std::filesystem::resize_file(PathOf(first), kMaxJournalBytes + (size_t{1} << 20));
  EXPECT_TRUE(Journal(Claim()).records().finished().empty());
}

}  // namespace
}  // namespace rollgait::server
