// The client's own commands against the real server and solver: a request as a file gives the same gait as its flags,
// and what is said about it is true of it.
#include <gmock/gmock.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "rollgait/v1/model_side_file.pb.h"
#include "tests/e2e/daemon.h"
#include "tests/server/store/temporary_directory.h"
#include "tests/support/certificates.h"

namespace rollgait::server {
namespace {

using testing::HasSubstr;

class CommandLineTest : public testing::Test {
 protected:
  CommandLineTest() : daemon_({.data_dir = directory_.path() + "/data", .solver = "", .flags = {}}) {}

  struct Ended {
    int code;
    std::string out, err;
  };
  Ended Run(const std::string& arguments) const {
    const std::string file = directory_.path() + "/out";
    const int status = std::system(("ROLLGAIT_CONFIG= " ROLLGAIT_PROGRAM " --server " + daemon_.address() + " " +
                                    arguments + " > " + file + " 2> " + file + ".err")
                                       .c_str());
    std::ostringstream out, err;
    out << std::ifstream(file).rdbuf();
    err << std::ifstream(file + ".err").rdbuf();
    return {WEXITSTATUS(status), out.str(), err.str()};
  }
  v1::Solve Solve(const std::string& arguments) const {
    const Ended ended = Run("solve -q -o - " + arguments);
    v1::Solve solve;
    EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(ended.out, &solve).ok()) << ended.code << ended.out;
    return solve;
  }

  const TemporaryDirectory directory_;
  const Daemon daemon_;
};

TEST_F(CommandLineTest, ASweepIsSolvedOnceFoundByItsLabelAndGoneOnWith) {
  ASSERT_NE(daemon_.address(), "");
  const std::string folder = directory_.path() + "/hills";
  const auto line = [&](const std::string& slopes) {
    return "sweep --model planar --cost torque --intervals 6 --accuracy draft --speed 1.2 --name hills --slope " +
           slopes + " --output " + folder + " --csv -";
  };
  const auto rows = [](const std::string& text) {
    std::istringstream lines(text);
    std::vector<std::string> read;
    for (std::string row; std::getline(lines, row);) read.push_back(row);
    return read;
  };
  const Ended first = Run(line("-2:2:2"));
  ASSERT_EQ(first.code, 0) << first.err;
  const std::vector<std::string> table = rows(first.out);
  ASSERT_EQ(table.size(), 4u) << first.out;
  EXPECT_EQ(table[1].rfind("-2,1.2,solves/", 0), 0u) << table[1];
  for (const char* name : {"slope_-2_speed_1.2", "slope_0_speed_1.2", "slope_2_speed_1.2"}) {
    EXPECT_TRUE(std::ifstream(folder + "/" + name + ".json").good()) << name;
  }
  const Ended longer = Run(line("-2:4:2"));
  ASSERT_EQ(longer.code, 0) << longer.err;
  const std::vector<std::string> longer_table = rows(longer.out);
  ASSERT_EQ(longer_table.size(), 5u) << longer.out;
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(longer_table[i], table[i]) << "the same solves, to the last digit";
  const Ended list = Run("list --label sweep=hills --termination optimal --json");
  EXPECT_EQ(rows(list.out).size(), 4u) << list.out;
  EXPECT_EQ(rows(Run("list --label sweep=dales --json").out).size(), 0u);
  const Ended wrong = Run("sweep --model planar --slope 0,80 --name wrong");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("requests[1].spec.slope_rad"));
  EXPECT_EQ(rows(Run("list --label sweep=wrong --json").out).size(), 0u) << "all or none";
}

TEST_F(CommandLineTest, ASceneTakesLongerWithLessErrorAndIsNotSimulatedTwice) {
  ASSERT_NE(daemon_.address(), "");
  const std::string line = "tradeoff --scene " ROLLGAIT_SCENES
                           "/rattleback.json --duration 3 --tolerance 1e-4,1e-9 --output " +
                           directory_.path() + "/front";
  const Ended ended = Run(line + " --json");
  ASSERT_EQ(ended.code, 0) << ended.err;
  const nlohmann::json data = nlohmann::json::parse(ended.out);
  const nlohmann::json &coarse = data.at("points").at(0), &fine = data.at("points").at(1);
  EXPECT_GT(double(coarse.at("pose_error")), 100 * double(fine.at("pose_error")));
  EXPECT_GT(double(fine.at("pose_error")), 0) << "the reference is finer";
  EXPECT_GT(double(fine.at("cpu_time_s")), 0);
  EXPECT_LT(int(coarse.at("evaluations")), int(fine.at("evaluations")));
  EXPECT_EQ(fine.at("on_front"), true) << "none is as accurate";
  const Ended again = Run(line + " --json");
  EXPECT_EQ(again.out, ended.out) << "times of a second run would differ";
}

TEST_F(CommandLineTest, ASpelledOutPresetIsSolvedLikeThePreset) {
  ASSERT_NE(daemon_.address(), "");
  const std::string request = "--model planar --preset human --cost force-rate:1e-8 --intervals 8 --accuracy draft";
  const std::string file = directory_.path() + "/request.json";
  ASSERT_EQ(Run("spec " + request + " -o " + file).code, 0);
  const v1::Solve flags = Solve(request), spelled = Solve("--spec " + file);
  EXPECT_EQ(spelled.spec().preset(), v1::PRESET_UNSPECIFIED);
  ASSERT_GT(spelled.spec().costs_size(), 1);
  EXPECT_FALSE(spelled.from_cache());
  ASSERT_EQ(flags.result().termination(), v1::TERMINATION_OPTIMAL) << flags.result().message();
  EXPECT_EQ(spelled.result().objective(), flags.result().objective());  // the same program, solved alike
  EXPECT_EQ(spelled.result().costs_size(), flags.result().costs_size());

  EXPECT_THAT(Run("list --termination optimal --since 1h").out, HasSubstr(flags.name()));
  EXPECT_EQ(Run("list --model human29").out, "");
  const Ended explained = Run("explain " + flags.name());
  EXPECT_THAT(explained.out, HasSubstr("The solver found a local optimum"));
  EXPECT_THAT(explained.out, HasSubstr("iterations in "));
}

// Gaits are told as they converge, the newest can be had from a solve that runs, and from one that was cancelled.
TEST_F(CommandLineTest, WhatASolveHasCanBeTaken) {
  ASSERT_NE(daemon_.address(), "");
  const std::string request = "--model human29 --preset transport --accuracy standard --max-error angle=0.001";
  const std::string name = Run("solve --detach " + request).out;
  const auto get = [&] {
    v1::Solve got;
    const Ended ended = Run("get --json " + name.substr(0, name.find('\n')));
    EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(ended.out, &got).ok()) << ended.out << ended.err;
    return got;
  };
  v1::Solve solve = get();
  for (int i = 0; i < 600 && !solve.has_intermediate(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    solve = get();
  }
  ASSERT_TRUE(solve.has_intermediate());
  EXPECT_GT(solve.intermediate().trajectory().phases_size(), 0);
  EXPECT_FALSE(solve.has_result());
  ASSERT_EQ(Run("cancel " + solve.name()).code, 0);
  const Ended watched = Run("watch " + solve.name());
  EXPECT_EQ(watched.code, 6);
  EXPECT_THAT(watched.err, HasSubstr("a gait on "));
  EXPECT_GT(get().result().trajectory().phases_size(), 0);
}

// What `models NAME --json` writes is a model of one's own, and the gait it gives is that of the name.
TEST_F(CommandLineTest, AModelInAFileWalksLikeTheOneOfThatName) {
  ASSERT_NE(daemon_.address(), "");
  const std::string file = directory_.path() + "/walker.json";
  const Ended written = Run("models human29 --json");
  std::ofstream(file) << written.out;
  const std::string rest = " --preset torque --intervals 8 --accuracy draft --slope 2";
  const v1::Solve named = Solve("--model human29" + rest), own = Solve("--model " + file + rest);
  ASSERT_EQ(named.result().termination(), v1::TERMINATION_OPTIMAL) << named.result().message();
  EXPECT_TRUE(own.spec().model().has_own());
  EXPECT_FALSE(own.from_cache());
  EXPECT_NEAR(own.result().objective(), named.result().objective(), 1e-9 * named.result().objective());

  // --model takes the place of what a request has, either way.
  const std::string request = directory_.path() + "/request.json";
  ASSERT_EQ(Run("spec --model planar --stature 1.7" + rest + " -o " + request).code, 0);
  EXPECT_EQ(Solve("--spec " + request + " --model " + file).result().objective(), own.result().objective());
  ASSERT_EQ(Run("spec --model " + file + rest + " -o " + request).code, 0);
  EXPECT_EQ(Solve("--spec " + request + " --model human29").result().objective(), named.result().objective());

  v1::Model model;
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(written.out, &model).ok());
  EXPECT_THAT(Run("models " + file).out, HasSubstr("ankle_l"));
  model.mutable_joints(7)->set_mass_kg(-1);
  std::string text;
  ASSERT_TRUE(google::protobuf::util::MessageToJsonString(model, &text).ok());
  std::ofstream(file) << text;
  for (const std::string& command : {"models " + file, "solve --model " + file}) {
    const Ended refused = Run(command);
    EXPECT_NE(refused.code, 0);
    EXPECT_THAT(refused.err, HasSubstr("model.own.joints[7].mass_kg"));
    EXPECT_THAT(refused.err, HasSubstr("is -1; must be finite and at least 0 kg"));
  }
  std::ofstream(file) << "{\"joints\": 3}";
  EXPECT_THAT(Run("models " + file).err, HasSubstr("not a proto3 JSON rollgait.v1.Model"));
  EXPECT_EQ(std::system(("truncate -s 65M " + file).c_str()), 0);
  EXPECT_THAT(Run("models " + file).err, HasSubstr("has more than 4 MiB"));
}

// A model that was written as URDF and side file gives the gait of its name, and a robot from elsewhere walks with the
// side file that is proposed for it.
TEST_F(CommandLineTest, ARobotInAUrdfWalks) {
  ASSERT_NE(daemon_.address(), "");
  const std::string urdf = directory_.path() + "/walker.urdf", side = directory_.path() + "/side.json";
  const std::string rest = " --preset torque --intervals 8 --accuracy draft --slope 2";
  for (const std::string model : {"planar", "human29"}) {
    ASSERT_EQ(Run("models " + model + " --format urdf -o " + urdf).code, 0);
    std::ofstream(side) << Run("models " + model + " --format urdf-side").out;
    const v1::Solve named = Solve("--model " + model + rest), own = Solve("--model " + urdf + " --side " + side + rest);
    ASSERT_EQ(named.result().termination(), v1::TERMINATION_OPTIMAL) << named.result().message();
    EXPECT_TRUE(own.spec().model().has_own());
    EXPECT_FALSE(own.from_cache());
    EXPECT_NEAR(own.result().objective(), named.result().objective(), 1e-9 * named.result().objective());
    ASSERT_EQ(own.result().trajectory().phases_size(), named.result().trajectory().phases_size());
    for (int p = 0; p < named.result().trajectory().phases_size(); ++p) {
      const v1::TrajectoryPhase &a = named.result().trajectory().phases(p), &b = own.result().trajectory().phases(p);
      const auto &expected = a.node_positions().values(), &found = b.node_positions().values();
      ASSERT_EQ(expected.size(), found.size());
      for (int i = 0; i < expected.size(); ++i) EXPECT_NEAR(expected[i], found[i], 1e-9);
    }
  }

  const std::string biped = ROLLGAIT_SOURCE "/examples/biped/biped.urdf";
  const Ended proposed = Run("models " + biped + " --propose-side");
  EXPECT_EQ(proposed.code, 0);
  EXPECT_THAT(proposed.err, HasSubstr("joint \"left_knee\" is ROLE_KNEE_FLEXION"));
  std::ofstream(side) << proposed.out;
  const Ended checked = Run("models " + biped + " --side " + side);
  EXPECT_EQ(checked.code, 0) << checked.err;
  EXPECT_THAT(checked.err, HasSubstr("\"imu\" into \"torso\": joint \"imu_mount\" is fixed"));
  EXPECT_THAT(checked.out, HasSubstr("leg length  0.84  m"));
  const v1::Solve walk = Solve("--model " + biped + " --side " + side + " --preset human --speed 0.8 --accuracy draft");
  EXPECT_EQ(walk.result().termination(), v1::TERMINATION_OPTIMAL) << walk.result().message();

  const Ended also_checked = Run("model check " + biped + " --side " + side);
  EXPECT_EQ(also_checked.code, 0) << also_checked.err;
  EXPECT_EQ(also_checked.out, checked.out);
  EXPECT_EQ(Run("model check " + biped).code, 2) << "no side file";
  EXPECT_EQ(Run("model check planar").code, 2) << "no file";
  const Ended fitted = Run("models fit-feet " + biped);
  EXPECT_EQ(fitted.code, 0) << fitted.err;
  EXPECT_THAT(fitted.err, HasSubstr("SEMI-AXES m"));
  v1::ModelSideFile feet, whole, only_feet;
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(fitted.out, &feet).ok()) << fitted.out;
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(proposed.out, &whole).ok());
  *only_feet.mutable_contacts() = whole.contacts();
  ASSERT_GT(feet.contacts_size(), 0);
  EXPECT_EQ(feet.SerializeAsString(), only_feet.SerializeAsString());
  EXPECT_EQ(Run("models fit-feet planar").code, 2) << "no file";

  EXPECT_EQ(Run("models create " + biped + " --side " + side + " --id biped").out, "models/biped@1\n");
  EXPECT_EQ(Run("solve --model " + biped).code, 2) << "no side file";
  EXPECT_EQ(Run("solve --model planar --side " + side).code, 2) << "no URDF";
  EXPECT_EQ(Run("models planar --propose-side").code, 2) << "no URDF";
  std::ofstream(urdf) << "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/></robot>";
  const Ended refused = Run("models " + urdf + " --side " + side);
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.out, "");
  EXPECT_THAT(refused.err,
              HasSubstr("walker.urdf:1: <robot name=\"r\">: has several links that are the child of no joint"));
}

// Files of MuJoCo and OpenSim go the same way: a side file is proposed, the server checks the model, and it walks.
TEST_F(CommandLineTest, BodiesOfMujocoAndOpensimWalk) {
  ASSERT_NE(daemon_.address(), "");
  const struct {
    const char *file, *joint, *left_out, *leg;
  } kFiles[] = {
      {"humanoid.xml", "joint \"left_knee\" is ROLE_KNEE_FLEXION", "<tendon>: a model has no tendons", "0.89  m"},
      {"walker.osim", "joint \"knee_angle_l\" is ROLE_KNEE_FLEXION", "<Thelen2003Muscle name=\"soleus_r\">",
       "0.8799  m"}};
  const std::string side = directory_.path() + "/side.json";
  for (const auto& [file, joint, left_out, leg] : kFiles) {
    SCOPED_TRACE(file);
    const std::string path = std::string(ROLLGAIT_SOURCE "/tests/data/") + file;
    const Ended proposed = Run("models " + path + " --propose-side");
    EXPECT_EQ(proposed.code, 0);
    EXPECT_THAT(proposed.err, HasSubstr(joint));
    EXPECT_THAT(proposed.err, testing::Not(HasSubstr("Missing")));
    std::ofstream(side) << proposed.out;
    const Ended checked = Run("models " + path + " --side " + side);
    EXPECT_EQ(checked.code, 0) << checked.err;
    EXPECT_THAT(checked.err, HasSubstr(left_out));
    EXPECT_THAT(checked.out, HasSubstr(leg));
    const v1::Solve walk = Solve("--model " + path + " --side " + side + " --preset human --speed 1 --accuracy draft");
    EXPECT_EQ(walk.result().termination(), v1::TERMINATION_OPTIMAL) << walk.result().message();
    EXPECT_EQ(Run("solve --model " + path).code, 2) << "no side file";
  }
}

// A model that is stored once walks like the one in the file, and a solve outlives the model it used.
TEST_F(CommandLineTest, AStoredModelWalksLikeTheOneInTheFile) {
  ASSERT_NE(daemon_.address(), "");
  const std::string file = directory_.path() + "/walker.json";
  std::ofstream(file) << Run("models planar --json").out;
  EXPECT_EQ(Run("models create " + file + " --id walker").out, "models/walker@1\n");
  EXPECT_EQ(Run("models create " + file + " --id walker").out, "models/walker@1\n");
  EXPECT_THAT(Run("models").out, HasSubstr("models/walker@1 "));
  const Ended stored = Run("models models/walker --json");
  const std::string again = directory_.path() + "/again.json";
  std::ofstream(again) << stored.out;
  EXPECT_EQ(Run("models create " + again + " --id walker").out, "models/walker@1\n") << "read back to the bit";
  EXPECT_THAT(Run("models models/walker").out, HasSubstr("stored as models/walker@1"));

  const std::string rest = " --preset torque --intervals 8 --accuracy draft --slope 2";
  const v1::Solve named = Solve("--model models/walker" + rest), own = Solve("--model " + file + rest);
  ASSERT_EQ(named.result().termination(), v1::TERMINATION_OPTIMAL) << named.result().message();
  EXPECT_NEAR(own.result().objective(), named.result().objective(), 1e-9 * own.result().objective());
  ASSERT_TRUE(named.spec().model().has_own());
  EXPECT_TRUE(Solve("--model models/walker@1" + rest).from_cache());
  EXPECT_EQ(Run("models delete walker").code, 0);
  EXPECT_NE(Run("solve --model models/walker" + rest).code, 0);
  EXPECT_THAT(Run("get " + named.name() + " --json").out, HasSubstr("\"own\""));
}

TEST_F(CommandLineTest, TheDoctorFindsAFreshServerWell) {
  ASSERT_NE(daemon_.address(), "");
  const Ended doctor = Run("doctor");
  EXPECT_EQ(doctor.code, 0) << doctor.out;
  EXPECT_THAT(doctor.out, HasSubstr("ok    versions: client "));
  EXPECT_THAT(doctor.out, HasSubstr("ok    clock: the server's clock is "));
  EXPECT_THAT(doctor.out, HasSubstr("ok    queue: 0 of "));
  EXPECT_THAT(doctor.out, HasSubstr("disk: store: sqlite, "));
}

TEST(CommandLineTlsTest, TheDoctorReadsTheServersCertificate) {
  const TemporaryDirectory directory;
  const auto path = [&](const std::string& name) { return directory.path() + "/" + name; };
  const Identity authority = MakeAuthority("authority"), server = MakeCertificate(authority, "gait.example");
  WriteFileAtOnce(path("ca.pem"), authority.cert);
  WriteFileAtOnce(path("server.pem"), server.cert);
  WriteFileAtOnce(path("server.key"), server.key);
  const Daemon daemon({.data_dir = path("data"),
                       .solver = "",
                       .flags = {"--tls-cert", path("server.pem"), "--tls-key", path("server.key")}});
  ASSERT_NE(daemon.address(), "");
  const auto doctor = [&](const std::string& authority_file) {
    const std::string command = "ROLLGAIT_CONFIG= " ROLLGAIT_PROGRAM " --server " + daemon.address() + " --tls-ca " +
                                authority_file + " doctor > " + path("out") + " 2> /dev/null";
    const int status = std::system(command.c_str());
    std::ostringstream out;
    out << std::ifstream(path("out")).rdbuf();
    return std::to_string(WEXITSTATUS(status)) + " " + out.str();
  };
  const std::string well = doctor(path("ca.pem"));
  // It is for a day from now only.
  EXPECT_THAT(well, testing::StartsWith("0 "));
  EXPECT_THAT(well, HasSubstr("ok    --tls-ca " + path("ca.pem") + ": authority"));
  EXPECT_THAT(well, HasSubstr("warn  server certificate: gait.example ("));
  EXPECT_THAT(well, HasSubstr("It expires soon: renew it."));
  WriteFileAtOnce(path("other.pem"), MakeAuthority("another").cert);
  const std::string ill = doctor(path("other.pem"));
  EXPECT_THAT(ill, testing::StartsWith("3 "));
  EXPECT_THAT(ill, HasSubstr("FAIL  server: "));
  EXPECT_THAT(ill, HasSubstr("give the right --tls-ca FILE"));
}

}  // namespace
}  // namespace rollgait::server
