// Shipped scenes with some numbers, names and flags replaced: each is refused by field or simulated to a reported end.

#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "server/convert/scene_convert.h"

namespace rollgait::server {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

constexpr int kMutants = 250;
constexpr int kSteps = 200;  // of the integrator, at most
constexpr double kNumbers[] = {0,    -1,  1,   1e-300, 1e300, -1e9, 1e9, 1e-9, 1e6, -1e-6, 0.5, 2, 1e-15, 100, 1e-3,
                               3.14, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()};

std::vector<v1::SimulationScene> ShippedScenes() {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(ROLLGAIT_SCENES)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<v1::SimulationScene> scenes;
  for (const auto& path : paths) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(text.str(), &scenes.emplace_back()).ok()) << path;
  }
  return scenes;
}

class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  unsigned Pick(size_t count) { return static_cast<unsigned>(random_() % count); }

  // Replaces one value somewhere in the message; mostly of a field that is set.
  void Mutate(Message* message) {
    const Reflection* reflection = message->GetReflection();
    std::vector<const FieldDescriptor*> fields;
    reflection->ListFields(*message, &fields);
    if (fields.empty() || Pick(3) == 0) {
      fields.push_back(message->GetDescriptor()->field(static_cast<int>(Pick(
          static_cast<size_t>(message->GetDescriptor()->field_count())))));
    }
    const FieldDescriptor* field = fields[Pick(fields.size())];
    if (!field->is_repeated()) return MutateSingle(message, reflection, field);
    const int size = reflection->FieldSize(*message, field);
    if (size == 0) return;
    const int index = static_cast<int>(Pick(static_cast<size_t>(size)));
    if (field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      Mutate(reflection->MutableRepeatedMessage(message, field, index));
    } else if (field->cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE) {
      reflection->SetRepeatedDouble(message, field, index, Number());
    }
  }

 private:
  double Number() { return kNumbers[Pick(std::size(kNumbers))]; }

  void MutateSingle(Message* message, const Reflection* reflection, const FieldDescriptor* field) {
    switch (field->cpp_type()) {
      case FieldDescriptor::CPPTYPE_MESSAGE:
        return Mutate(reflection->MutableMessage(message, field));
      case FieldDescriptor::CPPTYPE_DOUBLE:
        return reflection->SetDouble(message, field, Number());
      case FieldDescriptor::CPPTYPE_BOOL:
        return reflection->SetBool(message, field, Pick(2) == 0);
      case FieldDescriptor::CPPTYPE_INT32:
        return reflection->SetInt32(message, field, static_cast<int>(Pick(20)) - 5);
      case FieldDescriptor::CPPTYPE_ENUM:
        return reflection->SetEnumValue(message, field, static_cast<int>(Pick(5)));
      default:
        return;
    }
  }

  std::mt19937 random_;
};

TEST(MutatedScenes, AreRefusedByFieldOrSimulatedToAnEnd) {
  const std::vector<v1::SimulationScene> shipped = ShippedScenes();
  Mutator mutator(20261121);
  int refused = 0, simulated = 0;
  for (int i = 0; i < kMutants; ++i) {
    v1::SimulationScene message = shipped[mutator.Pick(shipped.size())];
    message.clear_output_step_s();
    for (unsigned k = 1 + mutator.Pick(4); k > 0; --k) mutator.Mutate(&message);
    const Result<SimulationScene> scene = DecodeScene(message);
    if (!scene.ok()) {
      ++refused;
      for (const Violation& violation : scene.violations()) {
        EXPECT_FALSE(violation.field.empty() || violation.message.empty()) << message.ShortDebugString();
      }
      continue;
    }
    SimulationScene bounded = scene.value();
    bounded.options.max_steps = std::min(bounded.options.max_steps, kSteps);
    int samples = 0;
    SimulationObserver observer;
    observer.sample = [&](const SimulationSample& sample) {
      EXPECT_TRUE(sample.q.allFinite() && sample.v.allFinite()) << message.ShortDebugString();
      return ++samples < 500;
    };
    const Result<SimulationReport> report = Simulate(bounded, observer);
    if (!report.ok()) continue;
    ++simulated;
    EXPECT_NE(EncodeReport(report.value(), bounded).end(), v1::SimulationReport::END_UNSPECIFIED);
  }
  EXPECT_GT(refused, kMutants / 4);
  EXPECT_GT(simulated, kMutants / 5);
}

}  // namespace
}  // namespace rollgait::server
