// `rollgait solve` and `rollgait watch` as a user sees them: the program as a process, a fake server behind a port.
#include <gmock/gmock.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/client/client_process.h"
#include "tests/client/fake_gait_service.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string ReadFile(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

class SolveCommandTest : public testing::Test {
 protected:
  std::vector<std::string> Arguments(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"--server", server_->address()});
    return arguments;
  }

  FakeGaitService service_;
  std::unique_ptr<FakeServer> server_ = std::make_unique<FakeServer>(service_);
};

TEST_F(SolveCommandTest, PrintsIterationsAndSummary) {
  ClientProcess client(Arguments({"solve", "--model", "planar", "--slope", "-10", "--speed", "1.3"}));
  EXPECT_EQ(client.Wait(), 0);
  EXPECT_THAT(client.err(), HasSubstr("objective"));
  EXPECT_THAT(client.err(), HasSubstr("9.960000e+02"));
  EXPECT_THAT(client.err(), Not(HasSubstr("\x1b")));
  EXPECT_THAT(client.out(),
              HasSubstr("solves/planar  optimal, accuracy within the requested bounds: The KKT conditions hold"));
  EXPECT_THAT(client.out(), HasSubstr("step length"));
  EXPECT_THAT(client.out(), HasSubstr("slip of a contact that rolls"));
  EXPECT_THAT(client.out(), HasSubstr("-10  °"));
  ASSERT_EQ(service_.created().size(), 1u);
  EXPECT_NEAR(service_.created()[0].spec().slope_rad(), -0.17453292519943295, 1e-15);
  EXPECT_EQ(service_.created()[0].spec().motion().speed_m_s(), 1.3);
  EXPECT_FALSE(service_.created()[0].request_id().empty());
}

TEST_F(SolveCommandTest, ATerminalGetsOneLineThatIsRewritten) {
  service_.SetIterations(200);
  ClientProcess::Options options;
  options.terminal = true;
  options.environment = {"NO_COLOR=1"};
  ClientProcess client(Arguments({"solve", "--model", "planar"}), options);
  EXPECT_EQ(client.Wait(), 0);
  EXPECT_THAT(client.err(), HasSubstr("\r\x1b[2Kmesh 0  iteration 199"));
  EXPECT_THAT(client.err(), Not(HasSubstr("\x1b[3")));  // no colour
  // 200 iterations at once are drawn a few times, not 200 times.
  EXPECT_LT(Lines(client.err()).size(), 20u);
}

TEST_F(SolveCommandTest, JsonIsOneObjectALineAndTheSolveLast) {
  ClientProcess client(Arguments({"--json", "solve", "--model", "planar"}));
  EXPECT_EQ(client.Wait(), 0);
  const std::vector<std::string> lines = Lines(client.out());
  ASSERT_EQ(lines.size(), 7u);  // running, 5 iterations, the solve
  for (int i = 0; i < 6; ++i) {
    v1::SolveEvent event;
    ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(lines[i], &event).ok()) << lines[i];
    EXPECT_EQ(event.sequence(), i + 1);
  }
  v1::Solve solve;
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(lines[6], &solve).ok());
  EXPECT_EQ(solve.result().termination(), v1::TERMINATION_OPTIMAL);
  EXPECT_EQ(client.err(), "");
}

TEST_F(SolveCommandTest, QuietSaysNothing) {
  ClientProcess client(Arguments({"-q", "solve", "--model", "planar"}));
  EXPECT_EQ(client.Wait(), 0);
  EXPECT_EQ(client.out() + client.err(), "");
}

TEST_F(SolveCommandTest, ExitCodesOfTheOutcomes) {
  const auto exit_code = [this](std::vector<std::string> arguments) {
    ClientProcess client(Arguments(std::move(arguments)));
    return client.Wait();
  };
  EXPECT_EQ(exit_code({"solve", "--model", "infeasible"}), 4);
  EXPECT_EQ(exit_code({"solve", "--model", "inaccurate"}), 8);
  EXPECT_EQ(exit_code({"watch", "inaccurate"}), 8);
  EXPECT_EQ(exit_code({"--json", "watch", "inaccurate"}), 8);
  EXPECT_EQ(exit_code({"solve", "--model", "draft"}), 0);
  EXPECT_EQ(exit_code({"solve", "--model", "crash"}), 5);
  EXPECT_EQ(exit_code({"solve", "--model", "refused"}), 2);
  EXPECT_EQ(exit_code({"watch", "nosuch"}), 7);
  EXPECT_EQ(exit_code({"solve", "--no-such-flag"}), 2);
  EXPECT_EQ(exit_code({"solve", "--scheme", "euler"}), 2);
  EXPECT_EQ(exit_code({"solve", "--model", "planar", "--output", "a.txt"}), 2);
  EXPECT_EQ(exit_code({"solve", "--model", "planar", "--spec", "no-such-file.json"}), 2);
  EXPECT_EQ(exit_code({}), 2);
  EXPECT_EQ(exit_code({"solve", "--help"}), 0);
  server_.reset();
  ClientProcess unreachable({"--server", "127.0.0.1:1", "solve", "--model", "planar"});
  EXPECT_EQ(unreachable.Wait(), 3);
  EXPECT_THAT(unreachable.err(), HasSubstr("rollgaitd --data-dir"));
}

TEST_F(SolveCommandTest, SaysWhatWasNotKeptAndWhatWasNotJudged) {
  ClientProcess inaccurate(Arguments({"-q", "solve", "--model", "inaccurate"}));
  EXPECT_EQ(inaccurate.Wait(), 8);
  EXPECT_EQ(inaccurate.out(), "");
  EXPECT_THAT(
      inaccurate.err(),
      HasSubstr("EXCEEDED: slip of a contact that rolls, 20 mm/s where 1 mm/s is allowed (left_foot at 0.31 s)"));
  ClientProcess draft(Arguments({"solve", "--model", "draft"}));
  EXPECT_EQ(draft.Wait(), 0);
  EXPECT_THAT(draft.out(), HasSubstr("Accuracy: not judged (draft)"));
  EXPECT_THAT(draft.out(), Not(HasSubstr("within")));
}

TEST_F(SolveCommandTest, NamesUnmetConstraintsAndFailures) {
  ClientProcess infeasible(Arguments({"solve", "--model", "infeasible"}));
  EXPECT_EQ(infeasible.Wait(), 4);
  EXPECT_THAT(infeasible.out(), HasSubstr("rolling left_foot  by 0.25 m/s"));
  ClientProcess crash(Arguments({"solve", "--model", "crash"}));
  EXPECT_EQ(crash.Wait(), 5);
  EXPECT_THAT(crash.out(), HasSubstr("failed (crash): the solver died three times"));
}

TEST_F(SolveCommandTest, ViolationsOneALine) {
  ClientProcess client(Arguments({"solve", "--model", "refused"}));
  EXPECT_EQ(client.Wait(), 2);
  EXPECT_THAT(Lines(client.err()), testing::IsSupersetOf({"  slope_rad: is 0.873, must be in [-0.785, 0.785]",
                                                          "  motion.speed_m_s: is 9, must be in (0, 4]"}));
  EXPECT_EQ(client.out(), "");
}

TEST_F(SolveCommandTest, ReattachesAfterBreaksAndMissesNothing) {
  service_.BreakAfter({2, 4, 4, 5});
  ClientProcess client(Arguments({"--json", "solve", "--model", "planar"}));
  EXPECT_EQ(client.Wait(), 0);
  const std::vector<std::string> lines = Lines(client.out());
  ASSERT_EQ(lines.size(), 7u);
  for (int i = 0; i < 6; ++i) {
    v1::SolveEvent event;
    ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(lines[i], &event).ok());
    EXPECT_EQ(event.sequence(), i + 1);
  }
  std::vector<int64_t> after;
  for (const auto& request : service_.watched()) after.push_back(request.after_sequence());
  EXPECT_THAT(after, testing::ElementsAre(0, 2, 4, 5));
}

TEST_F(SolveCommandTest, SurvivesARestartOfTheServer) {
  ClientProcess client(Arguments({"solve", "--model", "endless"}));
  ASSERT_TRUE(client.WaitForError("9.960000e+02")) << client.err();
  const int port = server_->port();
  server_.reset();
  ASSERT_TRUE(client.WaitForError("connection lost after event 6")) << client.err();
  server_ = std::make_unique<FakeServer>(service_, port);
  // The solve ends on the new server; the old stream's events do not come again.
  grpc::ServerContext context;
  v1::CancelSolveRequest request;
  request.set_name("solves/endless");
  v1::Solve solve;
  ASSERT_TRUE(service_.CancelSolve(&context, &request, &solve).ok());
  EXPECT_EQ(client.Wait(), 6);
  EXPECT_EQ(client.err().find("9.960000e+02"), client.err().rfind("9.960000e+02"));
  EXPECT_THAT(client.out(), HasSubstr("solves/endless  cancelled"));
}

TEST_F(SolveCommandTest, GivesUpWhenTheServerStaysAway) {
  ClientProcess client(Arguments({"solve", "--model", "endless", "--reconnect", "0.3"}));
  ASSERT_TRUE(client.WaitForError("9.960000e+02")) << client.err();
  server_.reset();
  EXPECT_EQ(client.Wait(), 3);
  EXPECT_THAT(client.err(), HasSubstr("rollgait watch solves/endless --after-sequence 6"));
}

TEST_F(SolveCommandTest, CtrlCCancelsAndWaitsForTheEnd) {
  ClientProcess client(Arguments({"solve", "--model", "endless"}));
  ASSERT_TRUE(client.WaitForError("9.960000e+02")) << client.err();
  client.Signal(SIGINT);
  EXPECT_EQ(client.Wait(), 6);
  EXPECT_THAT(service_.cancelled(), testing::ElementsAre("solves/endless"));
  EXPECT_THAT(client.out(), HasSubstr("solves/endless  cancelled"));
}

TEST_F(SolveCommandTest, SecondCtrlCLeavesAtOnce) {
  ClientProcess client(Arguments({"--timeout", "600", "solve", "--model", "endless"}));
  ASSERT_TRUE(client.WaitForError("9.960000e+02")) << client.err();
  server_.reset();  // Nobody answers the cancellation.
  client.Signal(SIGINT);
  ASSERT_TRUE(client.WaitForError("Ctrl-C again")) << client.err();
  client.Signal(SIGINT);
  EXPECT_EQ(client.Wait(), 6);
  EXPECT_THAT(client.err(), HasSubstr("may still be running"));
}

TEST_F(SolveCommandTest, CtrlCLeavesAWatchedSolveAlone) {
  ClientProcess solve(Arguments({"solve", "--model", "endless", "--detach"}));
  EXPECT_EQ(solve.Wait(), 0);
  EXPECT_EQ(solve.out(), "solves/endless\n");
  ClientProcess watch(Arguments({"watch", "endless", "--after-sequence", "3"}));
  ASSERT_TRUE(watch.WaitForError("9.960000e+02")) << watch.err();
  EXPECT_THAT(watch.err(), Not(HasSubstr("9.990000e+02")));
  watch.Signal(SIGINT);
  EXPECT_EQ(watch.Wait(), 6);
  EXPECT_TRUE(service_.cancelled().empty());
}

TEST_F(SolveCommandTest, ValidateOnlyStoresNothing) {
  ClientProcess good(Arguments({"solve", "--model", "planar", "--validate-only"}));
  EXPECT_EQ(good.Wait(), 0);
  EXPECT_TRUE(service_.created()[0].validate_only());
  EXPECT_TRUE(service_.watched().empty());
  ClientProcess bad(Arguments({"solve", "--model", "cat", "--validate-only"}));
  EXPECT_EQ(bad.Wait(), 2);
  EXPECT_THAT(bad.err(), HasSubstr("model.name: is \"cat\""));
}

TEST_F(SolveCommandTest, WritesTheOutputFile) {
  const std::string path = testing::TempDir() + "solve_output.json";
  std::filesystem::remove(path);
  ClientProcess client(Arguments({"solve", "--model", "planar", "-o", path}));
  EXPECT_EQ(client.Wait(), 0);
  v1::Solve solve;
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(ReadFile(path), &solve).ok());
  EXPECT_EQ(solve.name(), "solves/planar");
  EXPECT_EQ(solve.result().trajectory().phases_size(), 2);
}

TEST_F(SolveCommandTest, RefusesAnOutputDirectoryBeforeItAsksTheServer) {
  ClientProcess client(Arguments({"solve", "--model", "planar", "-o", testing::TempDir() + "no/such/dir/a.json"}));
  EXPECT_EQ(client.Wait(), 2);
  EXPECT_TRUE(service_.created().empty());
}

TEST_F(SolveCommandTest, ServerFromTheEnvironment) {
  ClientProcess::Options options;
  options.environment = {"ROLLGAIT_SERVER=" + server_->address()};
  ClientProcess client({"solve", "--model", "planar", "-q"}, options);
  EXPECT_EQ(client.Wait(), 0);
  EXPECT_EQ(service_.created().size(), 1u);
}

}  // namespace
}  // namespace rollgait::client
