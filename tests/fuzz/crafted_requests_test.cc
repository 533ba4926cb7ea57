// Requests that each break one rule of the proto's comments, sent to a real rollgaitd: each is refused with
// INVALID_ARGUMENT and a violation of that very field, and none reaches the store or a solver.
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "core/validation/criteria.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "tests/e2e/daemon.h"
#include "tests/fuzz/field_path.h"
#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using Random = std::mt19937_64;

// A number that must lie within [low, high]; `exclusive`: low itself is out of range.
struct NumberRule {
  std::string path;  // within SolveSpec; elements by index
  double low, high;
  bool exclusive = false;
  const char* base = "{\"model\": {\"name\": \"planar\"}}";
};

constexpr char kPhases[] = R"({"model": {"name": "planar"}, "phases": {"phases": [
    {"contacts": ["right_foot", "left_foot"]}, {"contacts": ["right_foot"]}]}})";
constexpr char kEffort[] = R"({"model": {"name": "planar"}, "costs": [{"muscleEffort": {}}]})";
constexpr char kMuscleWork[] = R"({"model": {"name": "planar"}, "costs": [{"muscleWork": {}}]})";
constexpr char kWork[] = R"({"model": {"name": "planar"}, "costs": [{"squaredTorque": {}}, {"mechanicalWork": {}}]})";
constexpr char kTracking[] =
    R"({"model": {"name": "planar"}, "costs": [{"tracking": {"channels": [{"joint": "knee_r", "positions": [0, 0.1]}]}}]})";

const NumberRule kWrittenNumbers[] = {
    {"slope_rad", -M_PI / 4, M_PI / 4},
    {"gravity_m_s2", 0.1, 100},
    {"starts", 1, 32},
    {"model.stature_m", 1.0, 2.3},
    {"model.body_mass_kg", 20, 250},
    {"motion.speed_m_s", 0, 4, true},
    {"motion.step_length_m", 0, 2, true},
    {"motion.step_duration_s", 0.1, 5},
    {"ground_contact.friction_coefficient", 0, 5, true},
    {"ground_contact.min_normal_force_bw", 0, 1},
    {"ground_contact.swing_clearance_m", 0, 0.3},
    {"discretization.single_support_intervals", 1, 1000},
    {"discretization.double_support_intervals", 1, 1000},
    {"accuracy.kkt_tolerance", 1e-12, 1e-2},
    {"accuracy.max_refinements", 0, 20},
    {"solver_limits.max_iterations", 1, 100'000},
    {"solver_limits.max_wall_time_s", 0.01, 86'400},
    {"phases.phases[0].intervals", 1, 1000, false, kPhases},
    {"phases.phases[1].intervals", 1, 1000, false, kPhases},
    {"phases.phases[1].min_duration_s", 0, 10, true, kPhases},
    {"phases.phases[1].max_duration_s", 0, 10, true, kPhases},
    {"costs[0].weight", 0, 1e6, false, kWork},
    {"costs[1].weight", 0, 1e6, false, kWork},
    {"costs[1].mechanical_work.smoothing_w", 0.01, 1000, false, kWork},
    {"costs[0].muscle_effort.exponent", 2, 10, false, kEffort},
    {"costs[0].muscle_work.positive_efficiency", 0.01, 100, false, kMuscleWork},
    {"costs[0].muscle_work.negative_efficiency", 0.01, 100, false, kMuscleWork},
    {"costs[0].muscle_work.smoothing_w", 0.01, 1000, false, kMuscleWork},
    {"costs[0].tracking.channels[0].weight", 0, 1e6, false, kTracking},
};

// Those, and the bound of every criterion.
std::vector<NumberRule> NumberRules() {
  std::vector<NumberRule> rules(std::begin(kWrittenNumbers), std::end(kWrittenNumbers));
  for (const CriterionTraits& traits : Criteria()) {
    rules.push_back({std::string("accuracy.") + traits.field, traits.least, traits.most});
  }
  return rules;
}

// An enumeration and where it is.
constexpr const char* kEnums[] = {
    "preset",   "cycle", "cost_normalization", "accuracy.level", "discretization.scheme", "ground_contact.touch_down",
    "model.sex"};

struct OtherRule {
  const char* path;
  std::function<void(v1::SolveSpec&, Random&)> spoil;
};

std::string Letters(Random& random) {
  std::string text;
  for (size_t i = 3 + random() % 20; i > 0; --i) text += static_cast<char>('a' + random() % 26);
  return "x" + text;
}

v1::SolveSpec FromJson(const std::string& json) {
  v1::SolveSpec spec;
  EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(json, &spec).ok()) << json;
  return spec;
}

std::vector<OtherRule> OtherRules() {
  return {
      {"model.name", [](v1::SolveSpec& spec, Random& random) { spec.mutable_model()->set_name(Letters(random)); }},
      {"model.name", [](v1::SolveSpec& spec, Random&) { spec.mutable_model()->clear_name(); }},
      {"phases.phases", [](v1::SolveSpec& spec, Random&) { spec.mutable_phases(); }},
      {"phases.phases[0].contacts",
       [](v1::SolveSpec& spec, Random& random) {
         spec.mutable_phases()->add_phases()->add_contacts(Letters(random));
         spec.mutable_phases()->add_phases()->add_contacts("right_foot");
       }},
      {"costs",
       [](v1::SolveSpec& spec, Random& random) {
         for (uint64_t i = 33 + random() % 100; i > 0; --i) spec.add_costs()->mutable_time();
       }},
      {"costs[0]", [](v1::SolveSpec& spec, Random&) { spec.add_costs()->set_weight(1); }},
      {"costs[0].squared_torque.joint_weights",
       [](v1::SolveSpec& spec, Random& random) {
         (*spec.add_costs()->mutable_squared_torque()->mutable_joint_weights())[Letters(random)] = 1;
       }},
      {"limits.joint_position",
       [](v1::SolveSpec& spec, Random& random) {
         v1::Range& range = (*spec.mutable_limits()->mutable_joint_position())["knee_r"];
         range.set_min(1);
         range.set_max(1 - static_cast<double>(random() % 1000) * 1e-3);
       }},
      {"limits.joint_velocity",
       [](v1::SolveSpec& spec, Random& random) {
         (*spec.mutable_limits()->mutable_joint_velocity())["knee_l"] = -static_cast<double>(random() % 1000);
       }},
      {"limits.joint_effort",
       [](v1::SolveSpec& spec, Random& random) {
         v1::Range& range = (*spec.mutable_limits()->mutable_joint_effort())["ankle_r"];
         range.set_min(1 + static_cast<double>(random() % 1000));  // zero is not within
         range.set_max(range.min() + 1);
       }},
      {"limits.joint_effort",
       [](v1::SolveSpec& spec, Random& random) {
         (*spec.mutable_limits()->mutable_joint_effort())[Letters(random)].set_max(1);
       }},
  };
}

// The message that holds the field of a path, made where it is missing, and the field.
std::pair<Message*, const FieldDescriptor*> Find(Message* message, const std::string& path) {
  const size_t dot = path.find('.');
  std::string name = path.substr(0, dot);
  const size_t bracket = name.find('[');
  const int index = bracket == std::string::npos ? -1 : std::stoi(name.substr(bracket + 1));
  const FieldDescriptor* field = message->GetDescriptor()->FindFieldByName(name.substr(0, bracket));
  if (dot == std::string::npos) return {message, field};
  Message* inner = index < 0 ? message->GetReflection()->MutableMessage(message, field)
                             : message->GetReflection()->MutableRepeatedMessage(message, field, index);
  return Find(inner, path.substr(dot + 1));
}

// Out of range by a random amount, from the least to the most that the type can hold.
double Beyond(const NumberRule& rule, bool integer, Random& random) {
  const double step =
      integer ? 1.0 + static_cast<double>(random() % 1'000'000) : std::ldexp(1.0, static_cast<int>(random() % 60) - 30);
  switch (random() % (integer ? 2 : 4)) {
    case 0:
      return rule.low == 0 && rule.exclusive && random() % 4 == 0 ? 0 : rule.low - step;
    case 1:
      return rule.high + step;
    case 2:
      return random() % 2 == 0 ? kInfinity : -kInfinity;
    default:
      return std::numeric_limits<double>::quiet_NaN();
  }
}

void SetNumber(const NumberRule& rule, v1::SolveSpec& spec, Random& random) {
  const auto [message, field] = Find(&spec, rule.path);
  if (field->cpp_type() == FieldDescriptor::CPPTYPE_INT32) {
    message->GetReflection()->SetInt32(message, field, static_cast<int32_t>(Beyond(rule, true, random)));
  } else {
    message->GetReflection()->SetDouble(message, field, Beyond(rule, false, random));
  }
}

struct Crafted {
  v1::CreateSolveRequest request;
  std::string path;  // of the field that breaks a rule
};

Crafted Craft(int number, Random& random) {
  static const std::vector<NumberRule> number_rules = NumberRules();
  static const std::vector<OtherRule> others = OtherRules();
  Crafted crafted;
  v1::SolveSpec& spec = *crafted.request.mutable_spec();
  spec = FromJson(number_rules[0].base);
  const size_t numbers = number_rules.size(), enums = std::size(kEnums);
  const size_t rule = static_cast<size_t>(number) % (numbers + enums + others.size() + 2);
  if (rule < numbers) {
    spec = FromJson(number_rules[rule].base);
    SetNumber(number_rules[rule], spec, random);
    crafted.path = "spec." + number_rules[rule].path;
  } else if (rule < numbers + enums) {
    const char* path = kEnums[rule - numbers];
    const auto [message, field] = Find(&spec, path);
    message->GetReflection()->SetEnumValue(message, field, 50 + static_cast<int>(random() % 100'000));
    crafted.path = std::string("spec.") + path;
  } else if (rule < numbers + enums + others.size()) {
    others[rule - numbers - enums].spoil(spec, random);
    crafted.path = std::string("spec.") + others[rule - numbers - enums].path;
  } else if (rule == numbers + enums + others.size()) {
    crafted.request.set_request_id(random() % 2 == 0 ? std::string(129 + random() % 500, 'r')
                                                     : "line\nfeed" + Letters(random));
    crafted.path = "request_id";
  } else {
    const int unknown = 2000 + static_cast<int>(random() % 100'000);
    spec.GetReflection()->MutableUnknownFields(&spec)->AddVarint(unknown, random());
    crafted.path = "spec." + std::to_string(unknown);
  }
  return crafted;
}

std::vector<std::string> ViolatedFields(const grpc::Status& status) {
  google::rpc::Status details;
  std::vector<std::string> fields;
  if (!details.ParseFromString(status.error_details())) return fields;
  for (const google::protobuf::Any& detail : details.details()) {
    google::rpc::BadRequest bad;
    if (!detail.UnpackTo(&bad)) continue;
    for (const auto& violation : bad.field_violations()) fields.push_back(violation.field());
  }
  return fields;
}

// The same field, or one of them holds the other.
bool SameField(const std::string& one, const std::string& other) {
  return one.rfind(other, 0) == 0 || other.rfind(one, 0) == 0;
}

TEST(CraftedRequests, AreRefusedByTheFieldThatBreaksTheRule) {
  const TemporaryDirectory directory;
  Daemon::Options options;
  options.data_dir = directory.path() + "/data";
  options.solver = SLOW_SOLVER;
  options.flags = {"--log-level", "warning"};
  const Daemon daemon(options);
  ASSERT_NE(daemon.address(), "");
  const auto stub = daemon.NewStub();
  Random random(20261121);
  std::set<std::string> paths;
  for (int i = 0; i < CRAFTED_REQUESTS; ++i) {
    const Crafted crafted = Craft(i, random);
    grpc::ClientContext context;
    v1::Solve solve;
    const grpc::Status status = stub->CreateSolve(&context, crafted.request, &solve);
    ASSERT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT)
        << crafted.path << ": " << status.error_message() << "\n"
        << crafted.request.ShortDebugString();
    const std::vector<std::string> fields = ViolatedFields(status);
    bool named = false;
    for (const std::string& field : fields) {
      EXPECT_TRUE(NamesField(*crafted.request.GetDescriptor(), field)) << field;
      named = named || SameField(field, crafted.path);
    }
    ASSERT_TRUE(named) << crafted.path << " was altered, refused was " << testing::PrintToString(fields) << "\n"
                       << crafted.request.ShortDebugString();
    paths.insert(crafted.path);
  }
  std::printf("%d crafted requests refused by their field, %zu fields\n", CRAFTED_REQUESTS, paths.size());
  grpc::ClientContext context;
  v1::ListSolvesResponse list;
  ASSERT_TRUE(stub->ListSolves(&context, {}, &list).ok());
  EXPECT_EQ(list.solves_size(), 0);
}

}  // namespace
}  // namespace rollgait::server
