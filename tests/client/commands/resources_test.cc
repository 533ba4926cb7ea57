// The commands that are one call: get, list, cancel, delete, models, server-info, report, help.
#include <gmock/gmock.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/client/client_process.h"
#include "tests/client/fake_gait_service.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;
using testing::Not;

class ResourceCommandTest : public testing::Test {
 protected:
  Ended Run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"--server", server_.address()});
    return RunToEnd(arguments);
  }
  void MakeSolves() const {
    ASSERT_EQ(Run({"-q", "solve", "--model", "planar", "--slope", "10"}).code, 0);
    ASSERT_EQ(Run({"-q", "solve", "--model", "endless", "--detach"}).code, 0);
  }

  FakeGaitService service_;
  FakeServer server_{service_};
};

TEST_F(ResourceCommandTest, ListTurnsPages) {
  MakeSolves();
  const Ended list = Run({"list"});
  EXPECT_EQ(list.code, 0);
  EXPECT_THAT(list.out, HasSubstr("solves/planar"));
  EXPECT_THAT(list.out, HasSubstr("solves/endless"));
  EXPECT_THAT(list.out, HasSubstr("10°"));
  EXPECT_THAT(list.out, testing::ContainsRegex("solves/planar +succeeded +optimal +within +planar"));
  EXPECT_THAT(list.out, testing::ContainsRegex("solves/endless +running +- +- +endless"));
  EXPECT_THAT(Run({"list", "--state", "running"}).out, Not(HasSubstr("solves/planar")));
  const Ended one = Run({"list", "--limit", "1"});
  EXPECT_THAT(one.out, Not(HasSubstr("solves/planar")));
  EXPECT_THAT(one.err, HasSubstr("there may be more"));
  EXPECT_EQ(Run({"list", "--state", "walking"}).code, 2);
}

TEST_F(ResourceCommandTest, LabelsAreGivenAndListed) {
  ASSERT_EQ(Run({"-q", "solve", "--model", "planar", "--label", "sweep=hills", "--label", "by=me"}).code, 0);
  ASSERT_EQ(Run({"-q", "solve", "--model", "draft"}).code, 0);
  EXPECT_EQ(service_.created()[0].labels().at("sweep"), "hills");
  EXPECT_EQ(service_.created()[0].labels().at("by"), "me");
  const Ended list = Run({"list", "--label", "sweep=hills", "--termination", "optimal"});
  EXPECT_THAT(list.out, HasSubstr("solves/planar"));
  EXPECT_THAT(list.out, Not(HasSubstr("solves/draft")));
  EXPECT_EQ(service_.listed().back().filter().termination(), v1::TERMINATION_OPTIMAL) << "the server filters";
  const Ended bad = Run({"solve", "--model", "planar", "--label", "hills"});
  EXPECT_EQ(bad.code, 2);
  EXPECT_THAT(bad.err, HasSubstr("--label hills: must be KEY=VALUE"));
}

TEST_F(ResourceCommandTest, CancelAndDeleteWhatCarriesALabel) {
  for (const char* model : {"planar", "endless"}) {
    ASSERT_EQ(Run({"-q", "solve", "--model", model, "--detach", "--label", "sweep=hills"}).code, 0);
  }
  ASSERT_EQ(Run({"-q", "solve", "--model", "draft", "--detach"}).code, 0);
  EXPECT_EQ(Run({"cancel"}).code, 2);
  EXPECT_EQ(Run({"delete", "--label", "hills"}).code, 2);
  EXPECT_EQ(Run({"cancel", "--label", "sweep=hills"}).out, "solves/endless  cancelled\n") << "planar has ended";
  EXPECT_EQ(Run({"cancel", "--label", "sweep=dales"}).out, "");
  EXPECT_EQ(Run({"delete", "--label", "sweep=hills"}).code, 0);
  EXPECT_THAT(service_.deleted(), testing::UnorderedElementsAre("solves/endless", "solves/planar"));
  EXPECT_THAT(Run({"list"}).out, HasSubstr("solves/draft"));
}

TEST_F(ResourceCommandTest, PrioritiesAreGivenListedAndChanged) {
  ASSERT_EQ(Run({"-q", "solve", "--model", "endless", "--detach", "--label", "sweep=hills"}).code, 0);
  EXPECT_THAT(Run({"list"}).out, Not(HasSubstr("PRIORITY"))) << "all have the usual one";
  ASSERT_EQ(Run({"-q", "solve", "--model", "draft", "--detach", "--priority", "-3"}).code, 0);
  EXPECT_EQ(service_.created().back().priority(), -3);
  EXPECT_THAT(Run({"list"}).out, testing::ContainsRegex("solves/draft .* -3\n"));
  EXPECT_EQ(Run({"priority", "draft", "--to", "10"}).out, "solves/draft  priority 10\n");
  EXPECT_EQ(Run({"get", "draft", "--json"}).out.find("\"priority\": 10") == std::string::npos, false);
  EXPECT_EQ(Run({"priority", "--label", "sweep=hills", "--to", "1"}).out, "") << "it does not wait any more";
  EXPECT_EQ(Run({"priority", "nosuch", "--to", "1"}).code, 7);
  EXPECT_EQ(Run({"priority", "draft"}).code, 2);
  EXPECT_EQ(Run({"priority", "--to", "1"}).code, 2);
  EXPECT_THAT(Run({"solve", "--model", "planar", "--priority", "11"}).err, HasSubstr("11"));
  EXPECT_EQ(Run({"priority", "draft", "--to", "-11"}).code, 2);
}

TEST_F(ResourceCommandTest, ListAsksForOtherTenants) {
  MakeSolves();
  EXPECT_THAT(Run({"list"}).out, Not(HasSubstr("TENANT")));
  const Ended all = Run({"list", "--all-tenants"});
  EXPECT_THAT(all.out, HasSubstr("TENANT"));
  EXPECT_THAT(all.out, HasSubstr("solves/planar"));
  EXPECT_THAT(Run({"list", "--tenant", "lab"}).err, HasSubstr("no solves"));
  EXPECT_EQ(Run({"list", "--tenant", "lab", "--all-tenants"}).code, 2);
}

TEST_F(ResourceCommandTest, GetByNameOrId) {
  MakeSolves();
  EXPECT_THAT(Run({"get", "planar"}).out, HasSubstr("solves/planar  optimal"));
  const Ended printed = Run({"get", "solves/planar", "--json"});
  v1::Solve solve;
  EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(printed.out, &solve).ok());
  EXPECT_EQ(solve.state(), v1::SOLVE_STATE_SUCCEEDED);
  EXPECT_THAT(Run({"get", "endless"}).out, HasSubstr("solves/endless  running"));
  const Ended missing = Run({"get", "nosuch"});
  EXPECT_EQ(missing.code, 7);
  EXPECT_THAT(missing.err, HasSubstr("rollgait list"));
}

TEST_F(ResourceCommandTest, CancelAndDelete) {
  MakeSolves();
  EXPECT_EQ(Run({"delete", "endless"}).code, 2);  // FAILED_PRECONDITION
  EXPECT_EQ(Run({"cancel", "endless", "nosuch"}).code, 7);
  EXPECT_THAT(service_.cancelled(), testing::ElementsAre("solves/endless"));
  EXPECT_EQ(Run({"delete", "endless", "planar"}).code, 0);
  EXPECT_THAT(service_.deleted(), testing::ElementsAre("solves/endless", "solves/planar"));
  EXPECT_EQ(Run({"delete", "planar"}).code, 7);
}

TEST_F(ResourceCommandTest, Models) {
  EXPECT_THAT(Run({"models"}).out, HasSubstr("planar"));
  const Ended whole = Run({"models", "planar", "--sex", "female", "--stature", "1.6"});
  EXPECT_EQ(whole.code, 0);
  EXPECT_THAT(whole.out, HasSubstr("ankle_r"));
  EXPECT_THAT(whole.out, HasSubstr("(0.13, 0.05, 0.06)"));
  v1::Model model;
  const Ended printed = Run({"models", "planar", "--sex", "female", "--stature", "1.6", "--json"});
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(printed.out, &model).ok());
  EXPECT_EQ(model.selection().sex(), v1::ModelSelection::SEX_FEMALE);
  EXPECT_EQ(model.selection().stature_m(), 1.6);
  EXPECT_EQ(Run({"models", "cat"}).code, 7);
}

TEST_F(ResourceCommandTest, AModelShowsWhatTheRequestChanges) {
  const std::string plain = Run({"models", "planar"}).out;
  EXPECT_THAT(plain, testing::ContainsRegex("\nleg length +[0-9.]+  m\n"));
  EXPECT_THAT(plain, testing::Not(HasSubstr("SPRING AT")));
  EXPECT_THAT(plain, testing::Not(HasSubstr("CHANGE")));
  const std::string changed =
      Run({"models", "--load", "hand_l=10", "planar", "--strength", "hip_l=0", "--spring", "ankle_l=340,18,2"}).out;
  EXPECT_THAT(changed, testing::ContainsRegex("load on hand_l +10 kg +at the centre of mass of the segment\n"));
  EXPECT_THAT(changed, testing::ContainsRegex("strength of hip_l +0 % +no muscles\n"));
  EXPECT_THAT(changed, testing::ContainsRegex("ankle_l +340 N m/rad +18° +2 N m s/rad\n"));
}

TEST_F(ResourceCommandTest, StoredModels) {
  const std::string file = testing::TempDir() + "resources_test.json";
  std::ofstream(file) << "{\"summary\": {\"name\": \"walker\"}}";
  EXPECT_EQ(Run({"models", "create", file}).out, "models/walker@1\n");
  EXPECT_EQ(Run({"models", "create", file, "--id", "models/other"}).out, "models/other@1\n");
  const Ended created = Run({"models", "create", file, "--id", "third", "--json"});
  v1::Model model;
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(created.out, &model).ok());
  EXPECT_EQ(model.summary().stored().name(), "models/third@1");
  const std::string list = Run({"models"}).out;
  for (const char* name : {"planar ", "models/walker@1 ", "models/other@1 ", "models/third@1 "}) {
    EXPECT_THAT(list, HasSubstr(name));
  }
  EXPECT_EQ(Run({"models", "delete", "walker", "models/other"}).code, 0);
  EXPECT_THAT(Run({"models"}).out, testing::Not(HasSubstr("walker")));
  const Ended gone = Run({"models", "delete", "walker", "third"});
  EXPECT_EQ(gone.code, 7);
  EXPECT_THAT(gone.err, HasSubstr("models/walker"));
  EXPECT_THAT(Run({"models"}).out, testing::Not(HasSubstr("third"))) << "every name is tried";
  EXPECT_EQ(Run({"models", "create"}).code, 2);
  EXPECT_EQ(Run({"models", "create", file + ".none"}).code, 2);
}

TEST_F(ResourceCommandTest, ServerInfoHelpAndVersion) {
  EXPECT_THAT(Run({"server-info"}).out, HasSubstr("1.2.3"));
  EXPECT_THAT(Run({"--help"}).out, HasSubstr("exit-codes"));
  EXPECT_THAT(Run({"help", "exit-codes"}).out, HasSubstr("4  the solve ended without a solution"));
  EXPECT_THAT(Run({"help", "formats"}).out, HasSubstr("opensim"));
  EXPECT_EQ(RunToEnd({}).code, 0);
  EXPECT_THAT(RunToEnd({}).out, HasSubstr("reproduce-paper"));
  EXPECT_THAT(Run({"help", "solve"}).out, HasSubstr("--slope"));
  EXPECT_EQ(Run({"help", "dance"}).code, 2);
  EXPECT_THAT(Run({"help", "exit-code"}).err, HasSubstr("did you mean exit-codes?"));
  EXPECT_THAT(Run({"--version"}).out, testing::StartsWith("rollgait "));
}

TEST_F(ResourceCommandTest, BadAddress) {
  for (const std::string address : {"nonsense", "localhost:", ":50551", "127.0.0.1:70000", "127.0.0.1:0x50"}) {
    ClientProcess client({"--server", address, "list"});
    EXPECT_EQ(client.Wait(), 2) << address;
    EXPECT_THAT(client.err(), HasSubstr("HOST:PORT")) << address;
  }
}

TEST_F(ResourceCommandTest, ReportOfServerAndFile) {
  MakeSolves();
  const std::string page = testing::TempDir() + "report.html";
  const std::string file = testing::TempDir() + "report_solve.json";
  ASSERT_EQ(Run({"get", "planar", "-q", "-o", file}).code, 0);
  const Ended report = Run({"report", "planar", file, "-o", page});
  EXPECT_EQ(report.code, 0) << report.err;
  std::ifstream stream(page);
  std::ostringstream text;
  text << stream.rdbuf();
  EXPECT_THAT(text.str(), HasSubstr("<title>Optimal gaits</title>"));
  EXPECT_THAT(text.str(), HasSubstr("solves/planar"));
  const Ended early = Run({"report", "endless", "-o", page});
  EXPECT_EQ(early.code, 2);
  EXPECT_THAT(early.err, HasSubstr("rollgait watch endless"));
  EXPECT_EQ(Run({"report", "nosuch", "-o", page}).code, 7);
}

}  // namespace
}  // namespace rollgait::client
