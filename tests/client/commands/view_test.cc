// view: the page in a browser, while a solve runs and after it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>

#include "client/view/http_library.h"
#include "tests/client/client_process.h"
#include "tests/client/fake_gait_service.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class ViewCommandTest : public testing::Test {
 protected:
  Ended Run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"--server", server_.address()});
    return RunToEnd(arguments);
  }
  // Starts `view`, and knows its address.
  void Start(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"--server", server_.address(), "view"});
    view_.emplace(arguments);
    ASSERT_TRUE(view_->WaitForError("serving the page until Ctrl-C")) << view_->err();
    ASSERT_THAT(view_->out(), StartsWith("http://127.0.0.1:"));
    const std::string url = view_->out().substr(0, view_->out().find('\n'));
    port_ = std::stoi(url.substr(sizeof("http://127.0.0.1:") - 1));
    path_ = url.substr(url.find('/', 7));
  }
  httplib::Client Client() const { return httplib::Client("127.0.0.1", port_); }
  std::string Page() const {
    const httplib::Result page = Client().Get(path_);
    return page ? page->body : "no answer";
  }
  // The exit code after Ctrl-C.
  int Interrupt() {
    view_->Signal(SIGINT);
    return view_->Wait();
  }

  FakeGaitService service_;
  FakeServer server_{service_};
  std::optional<ClientProcess> view_;
  int port_ = 0;
  std::string path_;
};

TEST_F(ViewCommandTest, FollowsARunningSolveAndThenShowsItsReport) {
  ASSERT_EQ(Run({"-q", "solve", "--model", "planar"}).code, 0);
  ASSERT_EQ(Run({"solve", "--model", "endless", "--detach"}).code, 0);
  Start({});  // the one that runs
  EXPECT_THAT(Page(), HasSubstr("<title>Solve in progress</title>"));
  std::string events;
  Client().Get(path_ + "events", [&](const char* data, size_t size) {
    events.append(data, size);
    return events.find("event: iterate\n") == std::string::npos ||
           events.find("event: iterations\n") == std::string::npos;
  });
  EXPECT_THAT(events, HasSubstr("data: \"The solve is running.\""));
  EXPECT_THAT(events, HasSubstr("data: {\"index\":4,\"mesh\":0,\"stride\":{"));
  EXPECT_THAT(events, HasSubstr("[0,0,1000.0,0.001,"));
  EXPECT_EQ(service_.watched().back().iterates_per_second(), 4);
  ASSERT_EQ(Run({"cancel", "endless"}).code, 0);
  ASSERT_TRUE(view_->WaitForError("solves/endless has ended: the page is its report"));
  EXPECT_THAT(Page(), HasSubstr("<title>Optimal gait</title>"));
  EXPECT_THAT(Page(), HasSubstr("\"name\":\"endless\"")) << "the model, which a solve without a result has not";
  EXPECT_EQ(Interrupt(), 0);
  EXPECT_FALSE(Client().Get(path_));
}

TEST_F(ViewCommandTest, ShowsAFinishedSolveByNameOrFile) {
  const std::string file = testing::TempDir() + "view_test_" + std::to_string(getpid()) + ".json";
  ASSERT_EQ(Run({"-q", "solve", "--model", "planar", "-o", file}).code, 0);
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{}, std::vector<std::string>{"planar"}, std::vector<std::string>{file}}) {
    Start(arguments);
    EXPECT_THAT(Page(), HasSubstr("<title>Optimal gait</title>"));
    EXPECT_EQ(Interrupt(), 0);
  }
  EXPECT_EQ(unlink(file.c_str()), 0);
}

TEST_F(ViewCommandTest, CtrlCEndsItWhileTheSolveRunsAndLeavesThatAlone) {
  ASSERT_EQ(Run({"solve", "--model", "endless", "--detach"}).code, 0);
  Start({"endless"});
  EXPECT_EQ(Interrupt(), 0);
  EXPECT_TRUE(service_.cancelled().empty());
}

TEST_F(ViewCommandTest, JsonHasTheAddressAndAWatcherWithoutAPageAsksForNoIterates) {
  ASSERT_EQ(Run({"-q", "solve", "--model", "planar"}).code, 0);
  EXPECT_EQ(service_.watched().back().iterates_per_second(), 0);
  view_.emplace(std::vector<std::string>{"--server", server_.address(), "--json", "view", "planar"});
  ASSERT_TRUE(view_->WaitForError("serving"));
  EXPECT_THAT(view_->out(), testing::MatchesRegex("\\{\"url\":\"http://127[^\"]*\"\\}\n"));
  EXPECT_EQ(Interrupt(), 0);
}

// With an xdg-open of the test's own, and without any.
TEST_F(ViewCommandTest, OpensThePageIfAsked) {
  ASSERT_EQ(Run({"-q", "solve", "--model", "planar"}).code, 0);
  const std::string folder = testing::TempDir() + "view_test_path_" + std::to_string(getpid());
  const std::string path = std::getenv("PATH"), opened = folder + "/opened", program = folder + "/xdg-open";
  ASSERT_TRUE(std::filesystem::create_directory(folder));
  ASSERT_EQ(setenv("PATH", folder.c_str(), 1), 0);
  Start({"planar", "--open"});
  EXPECT_TRUE(view_->WaitForError("xdg-open cannot be started (No such file or directory); open the address"));
  EXPECT_EQ(Interrupt(), 0);
  std::ofstream(program) << "#!/bin/sh\necho noise\n{ printf '%s\\n' \"$1\"; /bin/grep SigIgn /proc/$$/status; } > "
                         << opened << ".new && /bin/mv " << opened << ".new " << opened << "\n";
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  Start({"planar", "--open"});
  for (int i = 0; i < 3000 && !std::filesystem::exists(opened); ++i) usleep(10'000);
  std::string url, title, mask;
  std::ifstream(opened) >> url >> title >> mask;
  EXPECT_THAT(url, StartsWith("http://127.0.0.1:" + std::to_string(port_) + "/"));
  EXPECT_THAT(url, testing::Not(HasSubstr(path_))) << "other users can read what a program is started with";
  const httplib::Result first = Client().Get(url.substr(url.find('/', 7)));
  ASSERT_TRUE(first);
  EXPECT_EQ(first->status, 303);
  EXPECT_EQ(first->get_header_value("Location"), path_);
  ASSERT_EQ(title, "SigIgn:");
  EXPECT_EQ(std::stoull(mask, nullptr, 16) >> (SIGPIPE - 1) & 1, 0u) << mask;
  EXPECT_EQ(Interrupt(), 0);
  EXPECT_THAT(view_->out(), testing::Not(HasSubstr("noise")));
  EXPECT_EQ(setenv("PATH", path.c_str(), 1), 0);
  std::filesystem::remove_all(folder);
}

TEST_F(ViewCommandTest, SaysWhatItCannotShow) {
  const Ended none = Run({"view"});
  EXPECT_EQ(none.code, 7);
  EXPECT_THAT(none.err, HasSubstr("there are no solves on 127.0.0.1:"));
  EXPECT_EQ(Run({"view", "unknown"}).code, 7);
  EXPECT_EQ(Run({"view", "--port", "70000"}).code, 2);
}

}  // namespace
}  // namespace rollgait::client
