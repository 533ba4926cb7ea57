// What the commands have in common: mistyped words, settings, files from and to standard streams.
#include <gmock/gmock.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/client/client_process.h"
#include "tests/client/fake_gait_service.h"

namespace rollgait::client {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class HabitsTest : public testing::Test {
 protected:
  Ended Run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"--server", server_.address()});
    return RunToEnd(arguments);
  }
  static Ended RunIn(const std::vector<std::string>& environment, const std::vector<std::string>& arguments) {
    ClientProcess client(arguments, {false, environment});
    const int code = client.Wait();
    return {code, client.out(), client.err()};
  }
  template <typename Message>
  static Message FromJson(const std::string& text) {
    Message message;
    EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(text, &message).ok()) << text;
    return message;
  }

  FakeGaitService service_;
  FakeServer server_{service_};
};

TEST_F(HabitsTest, MistypedWordsAreToldWhatMayBeMeant) {
  const struct {
    std::vector<std::string> line;
    std::string says;
  } kCases[] = {
      {{"sovle"}, "sovle: no such command; did you mean solve?\nRun `rollgait --help`"},
      {{"solve", "--sloep", "10"},
       "--sloep: no such flag of solve; did you mean --slope?\nRun `rollgait solve --help`"},
      {{"solve", "--format", "json"}, "--format: no such flag of solve; --json writes JSON\n"},
      {{"solve", "--sever=a:1"}, "--sever: no such flag of solve; did you mean --server?"},
      {{"solve", "planar"}, "planar: solve does not take this word"},
      {{"solve", "--preset", "humen"}, "--preset humen: must be one of human, torque, transport; did you mean human?"},
      {{"list", "--verdict", "exceded"}, "did you mean exceeded?"},
      {{"export", "x.json", "--format", "opensm"}, "did you mean opensim?"},
      {{"get"}, "SOLVE is required"},
  };
  for (const auto& [line, says] : kCases) {
    const Ended ended = Run(line);
    EXPECT_EQ(ended.code, 2) << says;
    EXPECT_THAT(ended.err, StartsWith("rollgait: "));
    EXPECT_THAT(ended.err, HasSubstr(says));
    EXPECT_EQ(ended.out, "");
  }
}

TEST_F(HabitsTest, AnAliasIsTheCommand) {
  const Ended help = Run({"help", "models"});
  EXPECT_THAT(help.out, HasSubstr("fit-feet"));
  EXPECT_EQ(Run({"help", "model"}).out, help.out);
  EXPECT_EQ(Run({"model", "--help"}).out, help.out);
}

TEST_F(HabitsTest, SettingsNameTheServer) {
  const std::string file = testing::TempDir() + "habits_test.toml";
  std::ofstream(file) << "server = \"" << server_.address() << "\"\n";
  EXPECT_THAT(RunIn({"ROLLGAIT_CONFIG=" + file}, {"server-info"}).out, HasSubstr("1.2.3"));
  EXPECT_THAT(RunIn({"ROLLGAIT_SERVER=" + server_.address()}, {"server-info"}).out, HasSubstr("1.2.3"));
  EXPECT_EQ(RunIn({"ROLLGAIT_CONFIG=" + file, "ROLLGAIT_SERVER=127.0.0.1:1"}, {"server-info"}).code, 3);
  const Ended refused = RunIn({"ROLLGAIT_CONFIG=/no/such.toml"}, {"list"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("ROLLGAIT_CONFIG=/no/such.toml: cannot be read"));
}

TEST_F(HabitsTest, SpecWritesWhatSolveReads) {
  const std::string file = testing::TempDir() + "habits_spec.json";
  const Ended plain = Run({"spec", "--model", "planar", "--slope", "10", "--cost", "work:2", "-o", file});
  EXPECT_EQ(plain.code, 0) << plain.err;
  EXPECT_EQ(service_.created().size(), 0u);  // nothing to ask for
  EXPECT_EQ(Run({"solve", "-q", "--spec", file}).code, 0);
  ASSERT_EQ(service_.created().size(), 1u);
  EXPECT_EQ(service_.created()[0].spec().costs(0).weight(), 2);
  EXPECT_NEAR(service_.created()[0].spec().slope_rad(), 0.17453, 1e-5);
  const std::string piped = std::string(ROLLGAIT_PROGRAM) +
                            " spec --model planar --speed 1.1 | ROLLGAIT_CONFIG= " + ROLLGAIT_PROGRAM + " --server " +
                            server_.address() + " solve -q --spec -";
  EXPECT_EQ(std::system(("ROLLGAIT_CONFIG= " + piped).c_str()), 0);
  EXPECT_EQ(service_.created().back().spec().motion().speed_m_s(), 1.1);
}

TEST_F(HabitsTest, SpecSpellsThePresetOutWhereAServerAnswers) {
  const Ended spelled = Run({"spec", "--model", "planar", "--preset", "human"});
  EXPECT_EQ(spelled.code, 0);
  EXPECT_EQ(spelled.err, "");
  EXPECT_EQ(FromJson<v1::SolveSpec>(spelled.out).costs_size(), 1);
  EXPECT_TRUE(service_.created()[0].validate_only() && service_.created()[0].spell_out());
  const Ended kept = Run({"spec", "--model", "planar", "--preset", "human", "--keep-preset"});
  EXPECT_EQ(FromJson<v1::SolveSpec>(kept.out).preset(), v1::PRESET_HUMAN);
  EXPECT_EQ(service_.created().size(), 1u);
  service_.SetSpellsOut(false);
  const Ended old = Run({"spec", "--model", "planar", "--preset", "human"});
  EXPECT_EQ(old.code, 0);
  EXPECT_THAT(old.err, HasSubstr("the server left the request as it is"));
  EXPECT_EQ(FromJson<v1::SolveSpec>(old.out).preset(), v1::PRESET_HUMAN);
  const Ended alone = RunToEnd({"--server", "127.0.0.1:1", "spec", "--model", "planar", "--preset", "human"});
  EXPECT_EQ(alone.code, 0);
  EXPECT_EQ(FromJson<v1::SolveSpec>(alone.out).preset(), v1::PRESET_HUMAN);
  EXPECT_THAT(alone.err, HasSubstr("the preset is not spelled out and nothing is checked"));
  EXPECT_EQ(Run({"spec", "--model", "refused", "--preset", "human"}).code, 2);
}

TEST_F(HabitsTest, AMinusIsStandardOutput) {
  const Ended solve = Run({"solve", "--model", "planar", "-o", "-"});
  EXPECT_EQ(solve.code, 0);
  EXPECT_EQ(FromJson<v1::Solve>(solve.out).state(), v1::SOLVE_STATE_SUCCEEDED);
  EXPECT_THAT(solve.err, HasSubstr("optimal"));  // the summary
  EXPECT_EQ(FromJson<v1::Solve>(Run({"get", "planar", "-o", "-"}).out).name(), "solves/planar");
  EXPECT_EQ(FromJson<v1::Solve>(Run({"watch", "-q", "planar", "-o", "-"}).out).name(), "solves/planar");
  const Ended page = Run({"report", "planar", "-o", "-"});
  EXPECT_THAT(page.out, StartsWith("<!"));
  EXPECT_EQ(page.err, "");
  const Ended both = Run({"get", "planar", "-o", "-", "--json"});
  EXPECT_EQ(both.code, 2);
  EXPECT_THAT(both.err, HasSubstr("both write to standard output"));
}

TEST_F(HabitsTest, ListFilters) {
  ASSERT_EQ(Run({"-q", "solve", "--model", "planar"}).code, 0);
  ASSERT_EQ(Run({"-q", "solve", "--model", "draft"}).code, 0);
  ASSERT_EQ(Run({"-q", "solve", "--model", "endless", "--detach"}).code, 0);
  const Ended within = Run({"list", "--verdict", "within"});
  EXPECT_THAT(within.out, HasSubstr("solves/planar"));
  EXPECT_THAT(within.out, Not(HasSubstr("solves/draft")));
  EXPECT_THAT(Run({"list", "--model", "draft"}).out, Not(HasSubstr("solves/planar")));
  EXPECT_THAT(Run({"list", "--name", "pl"}).out, HasSubstr("solves/planar"));
  EXPECT_THAT(Run({"list", "--termination", "none"}).out, HasSubstr("solves/endless"));
  EXPECT_EQ(Run({"list", "--since", "yesterday"}).code, 2);
}

TEST_F(HabitsTest, ExplainAndDoctor) {
  ASSERT_EQ(Run({"-q", "solve", "--model", "infeasible"}).code, 4);
  const Ended explained = Run({"explain", "infeasible"});
  EXPECT_EQ(explained.code, 0);
  EXPECT_THAT(explained.out, HasSubstr("\"rolling left_foot\" is missed by 0.25 m/s"));
  EXPECT_EQ(Run({"explain", "infeasible", "--json"}).code, 2);
  const Ended well = Run({"doctor"});
  EXPECT_EQ(well.code, 0) << well.out;
  EXPECT_THAT(well.out, HasSubstr("ok    server: " + server_.address() + " answered"));
  EXPECT_THAT(well.out, HasSubstr("ok    TLS: none"));
  EXPECT_THAT(well.out, HasSubstr("warn  versions: client "));
  EXPECT_THAT(well.out, HasSubstr("ok    disk: store: sqlite, 5 GiB free"));
  const Ended ill = RunToEnd({"--server", "127.0.0.1:1", "doctor"});
  EXPECT_EQ(ill.code, 3);
  EXPECT_THAT(ill.out, HasSubstr("FAIL  server: "));
  EXPECT_THAT(ill.out, HasSubstr("Is a server running at 127.0.0.1:1?"));
}

}  // namespace
}  // namespace rollgait::client
