// Every promise of the model can be broken.
#include "tests/schedules/history_bench.h"

namespace rollgait::server {
namespace {

using Kind = StoreCall::Kind;

class HistoryModelTest : public HistoryBench {};

TEST_F(HistoryModelTest, AGoodHistoryIsGood) {
  Claim();
  const StoreCall append = Leased(Kind::kAppend);
  Log("a", "iteration");
  Commit(append);
  Succeed();
  model_.GetAnswered("a", 3, 3, "r");
  model_.Delivered("a", 1, {2, "running"});
  model_.DeleteAsked("a");
  solves_.clear();
  Commit({.kind = Kind::kDelete, .id = "a"});
  model_.DeleteAnswered("a");
  model_.Ended({}, [](int64_t, int64_t) { return std::vector<SeenEvent>(); });
  EXPECT_EQ(Violation(), "");
}

TEST_F(HistoryModelTest, NothingChangesAfterTheEnd) {
  Claim();
  Succeed();
  a().state = 1;
  Commit({Kind::kReclaimExpired});
  Expect("changes after its end");
}

TEST_F(HistoryModelTest, ThereIsOneResult) {
  Claim();
  Succeed();
  a().result = "another";
  Commit({Kind::kOther});
  Expect("changes after its end");
}

TEST_F(HistoryModelTest, TheResultIsTheOneThatWasGiven) {
  Claim();
  Succeed("another");
  Expect("another result than was given");
}

TEST_F(HistoryModelTest, LostLeasesWriteNothing) {
  Claim();
  const StoreCall old = Leased(Kind::kAppend);
  a().epoch = 2;
  Log("a", "iteration");
  Commit(old);
  EXPECT_NE(Violation(), "");
}

TEST_F(HistoryModelTest, LostLeasesAreRefused) {
  StoreCall old = Leased(Kind::kRenew);
  model_.Begin(old, now_);
  model_.LeasedAnswered(old, 0, false);
  Expect("which is over");
}

TEST_F(HistoryModelTest, HeldLeasesAreNotRefused) {
  Claim();
  StoreCall call = Leased(Kind::kRenew);
  model_.Begin(call, now_);
  model_.LeasedAnswered(call, 0, true);
  Expect("who is told that it is lost");
}

TEST_F(HistoryModelTest, AcknowledgedEventsAreHeld) {
  Claim();
  StoreCall call = Leased(Kind::kAppend);
  call.events = {{{3, "iteration"}}};
  model_.Begin(call, now_);
  model_.LeasedAnswered(call, 0, false);
  Expect("does not hold the acknowledged event 3");
}

TEST_F(HistoryModelTest, EventsHaveNoGaps) {
  Claim();
  const StoreCall call = Leased(Kind::kAppend);
  logs_[1].push_back({4, "iteration"});
  a().last_sequence = 4;
  a().held_events = 4;
  Commit(call);
  Expect("has no event 3");
}

TEST_F(HistoryModelTest, IterationsAreNotLeftOut) {
  Claim();
  const StoreCall call = Leased(Kind::kAppend);
  Log("a", "iteration 0 0 17");
  Log("a", "iteration 0 2 19");
  Commit(call);
  Expect("has lost the iteration before 2");
}

TEST_F(HistoryModelTest, EventsAreThereWithTheirCommit) {
  a().last_sequence = 2;
  Commit(Leased(Kind::kAppend));
  EXPECT_NE(Violation(), "");
}

TEST_F(HistoryModelTest, EventsStayAsTheyAre) {
  Claim();
  Succeed();
  logs_[1][1].what = "another";
  model_.Ended(solves_, [this](int64_t number, int64_t after) { return EventsOf(number, after); });
  Expect("holds another event 2");
}

TEST_F(HistoryModelTest, ReadersGetEventsInOrderAndAsTheyAre) {
  model_.Delivered("a", 1, {3, "running"});
  Expect("to a reader that has 1");
}

TEST_F(HistoryModelTest, ReadersGetNothingThatIsNotHeld) {
  model_.Delivered("a", 0, {1, "another"});
  Expect("that it does not hold");
}

TEST_F(HistoryModelTest, ARequestHasOneSolve) {
  solves_.push_back({.number = 2, .id = "b", .key = "k", .tag = "t", .state = 1});
  Log("b", "queued");
  Commit({Kind::kCreate, {"t"}});
  Expect("was made for t, which has a already");
}

TEST_F(HistoryModelTest, ARequestIsAnsweredWithOneSolve) {
  solves_.push_back({.number = 2, .id = "b", .key = "k", .tag = "u", .state = 1});
  Log("b", "queued");
  Commit({Kind::kCreate, {"u"}});
  model_.CreateAnswered("request", "t", "a");
  ASSERT_EQ(Violation(), "");
  model_.CreateAnswered("request", "u", "b");
  Expect("answers request, as a did before");
}

TEST_F(HistoryModelTest, AcknowledgedSolvesAreStored) {
  model_.CreateAnswered("request", "u", "b");
  Expect("was acknowledged and is not stored");
}

TEST_F(HistoryModelTest, ABatchIsThereAsAWhole) {
  solves_.push_back({.number = 2, .id = "b", .key = "k", .tag = "u", .state = 1});
  Log("b", "queued");
  Commit({Kind::kCreate, {"u", "v"}});
  Expect("for v: is not there after the commit");
}

TEST_F(HistoryModelTest, NothingVanishes) {
  solves_.clear();
  Commit({Kind::kOther});
  Expect("is gone and nobody removed it");
}

TEST_F(HistoryModelTest, NothingIsRemovedBeforeItsEnd) {
  solves_.clear();
  Commit({Kind::kRetain});
  Expect("is removed before it has ended");
}

TEST_F(HistoryModelTest, CancellationsThatAreAcknowledgedHappen) {
  model_.CancelAnswered("a");
  Expect("its cancellation was acknowledged");
}

TEST_F(HistoryModelTest, NothingIsCancelledUnasked) {
  a().state = 5;
  a().error = "cancelled";
  a().cancel_requested = true;
  Log("a", "finished");
  Commit({.kind = Kind::kCancel, .id = "a"});
  Expect("is cancelled, unasked");
}

TEST_F(HistoryModelTest, WhatIsToBeCancelledIsNotQueuedAgain) {
  Claim();
  a().cancel_requested = true;
  Commit({.kind = Kind::kCancel, .id = "a"});
  const StoreCall call = Leased(Kind::kGiveBack);
  a().state = 1;
  a().owner = "";
  Log("a", "queued");
  Commit(call);
  Expect("is queued again and was to be cancelled");
}

TEST_F(HistoryModelTest, LeasesThatHaveNotExpiredStay) {
  Claim();
  now_ = 999;
  a().state = 1;
  a().owner = "";
  Log("a", "queued");
  Commit({Kind::kReclaimExpired});
  Expect("whose lease has not expired");
}

TEST_F(HistoryModelTest, LivingAgentsKeepTheirSolves) {
  Claim();
  a().state = 1;
  a().owner = "";
  Log("a", "queued");
  Commit({.kind = Kind::kReclaimOwner, .owner = "agent"});
  Expect("which lives");
}

TEST_F(HistoryModelTest, EqualSolvesDoNotRunTogether) {
  Claim();
  solves_.push_back({.number = 2, .id = "b", .key = "k", .tag = "u", .state = 1});
  Log("b", "queued");
  Commit({Kind::kCreate, {"u"}});
  solves_[1].state = 2;
  solves_[1].owner = "other";
  solves_[1].epoch = 1;
  Log("b", "running");
  Commit({.kind = Kind::kClaim, .owner = "other"});
  Expect("runs beside the equal a");
}

TEST_F(HistoryModelTest, ReadersSeeTheEndThatThereIs) {
  Claim();
  Succeed();
  model_.GetAnswered("a", 3, 2, "");
  Expect("had ended, and is read in state 2");
}

TEST_F(HistoryModelTest, WhatIsThereIsFound) {
  model_.NotFoundAnswered("a");
  Expect("a client was told that it is not");
}

TEST_F(HistoryModelTest, EverySolveEnds) {
  model_.Ended(solves_, [this](int64_t number, int64_t after) { return EventsOf(number, after); });
  Expect("does not end though all faults have");
}

TEST_F(HistoryModelTest, AClaimIsGivenOnce) {
  Claim();
  model_.ClaimAnswered({"a", "agent", 1});
  ASSERT_EQ(Violation(), "");
  model_.ClaimAnswered({"a", "agent", 1});
  Expect("which is not its own");
}

}  // namespace
}  // namespace rollgait::server
