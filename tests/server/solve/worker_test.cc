#include "server/solve/worker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <new>
#include <stdexcept>
#include <utility>

#include "core/gait/iterate_sink.h"
#include "core/gait/newest_solution.h"
#include "server/base/framing.h"
#include "server/base/sanitized.h"
#include "server/base/wire.pb.h"
#include "tests/server/solve/scripted_solver.h"

namespace rollgait::server {
namespace {

using ::testing::HasSubstr;

class WorkerTest : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends_.data()), 0); }
  void TearDown() override {
    for (const int fd : ends_) {
      if (fd >= 0) close(fd);
    }
  }
  int parent() const { return ends_[0]; }
  int child() const { return ends_[1]; }
  void HangUp() { close(std::exchange(ends_[0], -1)); }

  void SendRequest(const std::string& model = "planar") {
    v1::SolveSpec spec;
    spec.mutable_model()->set_name(model);
    spec.mutable_motion()->set_speed_m_s(1.1);
    ASSERT_EQ(WriteFrame(parent(), spec.SerializeAsString()), FrameStatus::kOk);
    ASSERT_EQ(WriteFrame(parent(), journal_.SerializeAsString()), FrameStatus::kOk);
  }
  WorkerExit Serve(const ScriptedSolver::Script& script) {
    ScriptedSolver solver(script);
    return ServeOneRequest(child(), solver, stop_, [&](const GaitSpec&) { ++requests_; });
  }
  wire::SolverMessage Receive() {
    std::string payload;
    wire::SolverMessage message;
    EXPECT_EQ(ReadFrame(parent(), &payload), FrameStatus::kOk);
    EXPECT_TRUE(message.ParseFromString(payload));
    return message.has_ready() || message.has_taken() ? Receive() : message;
  }

  std::array<int, 2> ends_ = {-1, -1};
  StopFlag stop_;
  wire::Journal journal_;  // what follows the request
  int requests_ = 0;
};

GaitSolution Optimal(const GaitSpec&, const SolveControl&) { return EndedWith(Termination::kOptimal); }

TEST_F(WorkerTest, SendsAnIterateAtOnceAndNoneInThePauseAfterIt) {
  SendRequest();
  EXPECT_EQ(Serve([](const GaitSpec& spec, const SolveControl& control) {
              CoarseMotion motion;
              motion.duration = 0.5;
              motion.phases.push_back({{0}, 0, 0.5, {0, 0.5}, MatrixX::Zero(spec.scene.model.size(), 2)});
              for (int i = 0; i < 3; ++i) {
                IterationInfo iteration;
                iteration.index = i;
                if (control.iterates->Wants()) control.iterates->Take(iteration, motion);
              }
              return EndedWith(Termination::kOptimal);
            }),
            kWorkerDone);
  const wire::SolverMessage first = Receive();
  ASSERT_TRUE(first.has_iterate());
  EXPECT_EQ(first.iterate().index(), 0);
  EXPECT_EQ(first.iterate().duration_s(), 0.5);
  EXPECT_EQ(first.iterate().phases(0).positions_size(), 2 * first.iterate().joint_names_size());
  EXPECT_TRUE(Receive().has_result());
}

TEST_F(WorkerTest, SendsSolutionsThatDoNotSayHowTheSearchEnds) {
  SendRequest();
  EXPECT_EQ(Serve([](const GaitSpec&, const SolveControl& control) {
              GaitSolution solution = EndedWith(Termination::kOptimal);
              solution.objective = 7;
              control.solutions->Take(solution);
              return EndedWith(Termination::kTimeLimit);
            }),
            kWorkerDone);
  const wire::SolverMessage first = Receive();
  ASSERT_TRUE(first.has_intermediate());
  EXPECT_EQ(first.intermediate().objective(), 7);
  EXPECT_EQ(first.intermediate().termination(), v1::TERMINATION_UNSPECIFIED);
  EXPECT_EQ(Receive().result().termination(), v1::TERMINATION_TIME_LIMIT);
}

TEST_F(WorkerTest, SendsNoIterateThatIsNotFinite) {
  SendRequest();
  EXPECT_EQ(Serve([](const GaitSpec& spec, const SolveControl& control) {
              CoarseMotion motion;
              motion.phases.push_back({{0}, 0, 0.5, {0, 0.5}, MatrixX::Zero(spec.scene.model.size(), 2)});
              motion.phases[0].positions(0, 1) = std::nan("");
              EXPECT_TRUE(control.iterates->Wants());
              control.iterates->Take({}, motion);
              return EndedWith(Termination::kOptimal);
            }),
            kWorkerDone);
  EXPECT_TRUE(Receive().has_result());
}

TEST_F(WorkerTest, SendsIterationsAndThenTheResult) {
  SendRequest();
  EXPECT_EQ(Serve([](const GaitSpec& spec, const SolveControl& control) {
              EXPECT_EQ(spec.speed, 1.1);
              for (int i = 0; i < 3; ++i) {
                IterationInfo iteration;
                iteration.index = i;
                control.observer(iteration);
              }
              return EndedWith(Termination::kOptimal);
            }),
            kWorkerDone);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(Receive().iteration().index(), i);
  const wire::SolverMessage last = Receive();
  EXPECT_EQ(last.result().termination(), v1::TERMINATION_OPTIMAL);
  EXPECT_THAT(last.result().solver_build(), HasSubstr("Ipopt"));
  EXPECT_GT(last.result().model().joints_size(), 0);
  EXPECT_EQ(requests_, 1);
}

TEST_F(WorkerTest, SaysThatItIsReadyAndEndsQuietlyWithoutARequest) {
  shutdown(parent(), SHUT_WR);
  EXPECT_EQ(Serve(Optimal), kWorkerDone);
  std::string payload;
  wire::SolverMessage message;
  EXPECT_EQ(ReadFrame(parent(), &payload), FrameStatus::kOk);
  EXPECT_TRUE(message.ParseFromString(payload));
  EXPECT_TRUE(message.has_ready());
  EXPECT_EQ(requests_, 0);
}

TEST_F(WorkerTest, SaysThatTheRequestHasArrivedBeforeItIsRead) {
  ASSERT_EQ(WriteFrame(parent(), "no SolveSpec"), FrameStatus::kOk);
  EXPECT_EQ(Serve(Optimal), kWorkerNoRequest);
  std::string payload;
  wire::SolverMessage message;
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(ReadFrame(parent(), &payload), FrameStatus::kOk);
    EXPECT_TRUE(message.ParseFromString(payload));
  }
  EXPECT_TRUE(message.has_taken());
  EXPECT_TRUE(Receive().has_error());
}

TEST_F(WorkerTest, GarbageIsNoRequest) {
  ASSERT_EQ(write(parent(), "GET / HTTP/1.1\r\n\r\n", 18), 18);
  EXPECT_EQ(Serve(Optimal), kWorkerNoRequest);
  EXPECT_EQ(Receive().error().kind(), v1::SolveError::KIND_INTERNAL);
}

TEST_F(WorkerTest, AFrameThatIsNoSpecIsNoRequest) {
  ASSERT_EQ(WriteFrame(parent(), "\xff\xff\xff"), FrameStatus::kOk);
  EXPECT_EQ(Serve(Optimal), kWorkerNoRequest);
  EXPECT_THAT(Receive().error().message(), HasSubstr("not a SolveSpec"));
}

v1::SolveSpec AskingForAStart() {
  v1::SolveSpec spec;
  spec.mutable_model()->set_name("planar");
  spec.set_warm_start("nearest");
  return spec;
}

TEST_F(WorkerTest, AnEmptyStartIsAColdOne) {
  ASSERT_EQ(WriteFrame(parent(), AskingForAStart().SerializeAsString()), FrameStatus::kOk);
  ASSERT_EQ(WriteFrame(parent(), ""), FrameStatus::kOk);
  ASSERT_EQ(WriteFrame(parent(), ""), FrameStatus::kOk);
  EXPECT_EQ(Serve([](const GaitSpec& spec, const SolveControl&) {
              EXPECT_FALSE(spec.warm_start);
              return EndedWith(Termination::kOptimal);
            }),
            kWorkerDone);
  EXPECT_FALSE(Receive().result().has_warm_started_from());
}

TEST_F(WorkerTest, ARequestWithoutItsStartIsNone) {
  ASSERT_EQ(WriteFrame(parent(), AskingForAStart().SerializeAsString()), FrameStatus::kOk);
  shutdown(parent(), SHUT_WR);
  EXPECT_EQ(Serve(Optimal), kWorkerNoRequest);
  EXPECT_THAT(Receive().error().message(), HasSubstr("not followed by its warm start"));
}

TEST_F(WorkerTest, AStartOfAnotherBodyIsRefused) {
  wire::WarmStart start;
  start.mutable_trajectory()->add_joint_names("tail");
  ASSERT_EQ(WriteFrame(parent(), AskingForAStart().SerializeAsString()), FrameStatus::kOk);
  ASSERT_EQ(WriteFrame(parent(), start.SerializeAsString()), FrameStatus::kOk);
  EXPECT_EQ(Serve(Optimal), kWorkerNoRequest);
  EXPECT_THAT(Receive().error().message(), HasSubstr("warm_start: its solution has other joints"));
}

TEST_F(WorkerTest, ARefusedRequestNamesItsField) {
  SendRequest("horse");
  EXPECT_EQ(Serve(Optimal), kWorkerDone);
  EXPECT_THAT(Receive().error().message(), HasSubstr("model.name"));
}

TEST_F(WorkerTest, ExceptionsBecomeErrors) {
  SendRequest();
  EXPECT_EQ(Serve([](const GaitSpec&, const SolveControl&) -> GaitSolution { throw std::runtime_error("oops"); }),
            kWorkerDone);
  const wire::SolverMessage message = Receive();
  EXPECT_EQ(message.error().kind(), v1::SolveError::KIND_INTERNAL);
  EXPECT_THAT(message.error().message(), HasSubstr("oops"));
}

TEST_F(WorkerTest, RunningOutOfMemoryIsTheMemoryLimit) {
  SendRequest();
  EXPECT_EQ(Serve([](const GaitSpec&, const SolveControl&) -> GaitSolution { throw std::bad_alloc(); }), kWorkerDone);
  EXPECT_EQ(Receive().error().kind(), v1::SolveError::KIND_MEMORY_LIMIT);
}

TEST_F(WorkerTest, StopsWhenNobodyReads) {
  SendRequest();
  EXPECT_EQ(Serve([&](const GaitSpec&, const SolveControl& control) {
              HangUp();
              int iterations = 0;
              while (!control.stop->requested() && ++iterations < 1000) control.observer({});
              EXPECT_LT(iterations, 1000);
              return EndedWith(Termination::kCancelled);
            }),
            kWorkerNoReader);
  EXPECT_TRUE(stop_.requested());
}

// In a child process, since the handler ends it: a `new` that a library would have caught.
TEST_F(WorkerTest, AFailedNewAnywhereReportsTheMemoryLimit) {
  if (kSanitized) GTEST_SKIP() << "sanitizers end the process at a failed new";
  const pid_t pid = fork();
  if (pid == 0) {
    ReportMemoryLimitOn(child());
    try {
      void* volatile block = ::operator new(PTRDIFF_MAX);
      ::operator delete(block);
    } catch (...) {
    }
    _exit(99);
  }
  EXPECT_EQ(Receive().error().kind(), v1::SolveError::KIND_MEMORY_LIMIT);
}

}  // namespace
}  // namespace rollgait::server
