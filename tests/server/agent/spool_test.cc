#include "server/agent/spool.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <fstream>

#include "tests/server/agent/agent_fixture.h"

namespace rollgait::server {
namespace {

class SpoolTest : public AgentFixture {
 protected:
  std::string Directory() const { return directory_ + "/spool"; }
  Spool Open() const { return Spool::Open(Directory()).value(); }
};

PendingEnd Pending(const std::string& id, int64_t epoch) {
  return {{id, "owner", epoch},
          {{0, EventKind::kIteration, "first"}, {0, EventKind::kIteration, ""}},
          {SolveState::kSucceeded, std::string("re\0sult", 7), "", true}};
}

TEST_F(SpoolTest, WhatIsPutIsReadByTheNextProcess) {
  ASSERT_TRUE(Open().Put(Pending("a", 7)).ok());
  const std::vector<PendingEnd> ends = Open().ReadAll();
  ASSERT_EQ(ends.size(), 1u);
  EXPECT_EQ(ends[0].lease.solve_id, "a");
  EXPECT_EQ(ends[0].lease.owner, "owner");
  EXPECT_EQ(ends[0].lease.epoch, 7);
  EXPECT_EQ(ends[0].end.state, SolveState::kSucceeded);
  EXPECT_EQ(ends[0].end.result, std::string("re\0sult", 7));
  EXPECT_TRUE(ends[0].end.reusable);
  ASSERT_EQ(ends[0].events.size(), 2u);
  EXPECT_EQ(ends[0].events[0].payload, "first");
  EXPECT_EQ(ends[0].events[0].kind, EventKind::kIteration);
}

TEST_F(SpoolTest, RemoveRemovesThatEpochOnly) {
  const Spool spool = Open();
  ASSERT_TRUE(spool.Put(Pending("a", 1)).ok());
  ASSERT_TRUE(spool.Put(Pending("a", 2)).ok());
  spool.Remove(Pending("a", 1).lease);
  const std::vector<PendingEnd> ends = spool.ReadAll();
  ASSERT_EQ(ends.size(), 1u);
  EXPECT_EQ(ends[0].lease.epoch, 2);
}

TEST_F(SpoolTest, DamagedAndUnfinishedFilesAreNotReplayed) {
  const Spool spool = Open();
  ASSERT_TRUE(spool.Put(Pending("a", 1)).ok());
  std::filesystem::resize_file(Directory() + "/a-1.end", std::filesystem::file_size(Directory() + "/a-1.end") - 1);
  std::ofstream(Directory() + "/b-1.end") << "what is this?";
  std::ofstream(Directory() + "/c-1.end.tmp") << "half";
  EXPECT_TRUE(spool.ReadAll().empty());
  EXPECT_TRUE(std::filesystem::exists(Directory() + "/a-1.end.bad"));
  EXPECT_TRUE(std::filesystem::exists(Directory() + "/b-1.end.bad"));
  EXPECT_FALSE(std::filesystem::exists(Directory() + "/c-1.end.tmp")) << "its writer is dead";
}

TEST_F(SpoolTest, WhatIsBeingWrittenIsLeftAlone) {
  const Spool spool = Open();
  const std::string path = Directory() + "/a-1.end.tmp";
  const int writer = open(path.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
  ASSERT_EQ(flock(writer, LOCK_EX), 0);
  EXPECT_TRUE(spool.ReadAll().empty());
  EXPECT_TRUE(std::filesystem::exists(path));
  close(writer);
  EXPECT_TRUE(spool.ReadAll().empty());
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST_F(SpoolTest, ADirectoryThatCannotBeMadeIsAnError) {
  const Outcome<Spool> spool = Spool::Open(directory_ + "/no/such");
  ASSERT_FALSE(spool.ok());
  EXPECT_NE(spool.error().message.find("No such file"), std::string::npos);
}

TEST_F(SpoolTest, ReplayCommitsWhatIsStillOursAndDropsTheRest) {
  const std::string id = Queue("result");
  const ClaimedSolve claimed = *store_->ClaimNext("owner", kLeaseDuration).value();
  const Spool spool = Open();
  v1::SolveEvent event;
  event.mutable_iteration()->set_index(3);
  PendingEnd pending = Pending(id, claimed.lease.epoch);
  pending.events = {{0, EventKind::kIteration, event.SerializeAsString()}};
  ASSERT_TRUE(spool.Put(pending).ok());
  ASSERT_TRUE(spool.Put(Pending(id, claimed.lease.epoch + 5)).ok());
  EXPECT_TRUE(ReplaySpool(spool, *store_, [](const std::string& owner) { return owner != "owner"; }).empty());
  EXPECT_EQ(spool.ReadAll().size(), 2u) << "a living agent commits for itself";
  const auto dead = [](const std::string&) { return true; };
  EXPECT_EQ(ReplaySpool(spool, *store_, dead), std::vector<std::string>{id});
  EXPECT_TRUE(spool.ReadAll().empty());
  EXPECT_EQ(Get(id).state, SolveState::kSucceeded);
  EXPECT_EQ(CountIterations(id), 1);
  EXPECT_TRUE(ReplaySpool(spool, *store_, dead).empty()) << "a second replay finds nothing";
}

}  // namespace
}  // namespace rollgait::server
