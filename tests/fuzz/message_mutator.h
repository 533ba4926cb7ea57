#ifndef ROLLGAIT_TESTS_FUZZ_MESSAGE_MUTATOR_H_
#define ROLLGAIT_TESTS_FUZZ_MESSAGE_MUTATOR_H_

#include <google/protobuf/message.h>

#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "tests/fuzz/split_mix.h"

namespace rollgait {

// Changes messages of any type, mostly where they are set. Equal seeds: equal changes.
class MessageMutator {
 public:
  enum class Reach {
    kValues,      // numbers, flags and small enum values
    kEverything,  // also texts, unknown enum values, elements that come and go, fields that are cleared
  };
  explicit MessageMutator(unsigned seed, Reach reach = Reach::kEverything) : random_(seed), reach_(reach) {}

  unsigned Pick(size_t count) { return static_cast<unsigned>(random_() % count); }

  // Replaces one value somewhere in the message.
  void Mutate(google::protobuf::Message* message) {
    const Reflection* reflection = message->GetReflection();
    std::vector<const Field*> fields;
    reflection->ListFields(*message, &fields);
    if (fields.empty() || Pick(3) == 0) {
      const auto count = static_cast<size_t>(message->GetDescriptor()->field_count());
      if (count == 0) return;
      fields.push_back(message->GetDescriptor()->field(static_cast<int>(Pick(count))));
    }
    const Field* field = fields[Pick(fields.size())];
    if (reach_ == Reach::kEverything && Pick(12) == 0) return reflection->ClearField(message, field);
    if (!field->is_repeated()) return MutateSingle(message, reflection, field);
    MutateRepeated(message, reflection, field);
  }

 private:
  using Field = google::protobuf::FieldDescriptor;
  using Reflection = google::protobuf::Reflection;

  double Number() {
    static constexpr double kNumbers[] = {0,
                                          -1,
                                          1,
                                          1e-300,
                                          1e300,
                                          -1e9,
                                          1e9,
                                          1e-9,
                                          1e6,
                                          -1e-6,
                                          0.5,
                                          2,
                                          1e-15,
                                          100,
                                          1e-3,
                                          3.14,
                                          std::numeric_limits<double>::quiet_NaN(),
                                          std::numeric_limits<double>::infinity()};
    if (reach_ == Reach::kEverything && Pick(4) == 0)
      return std::ldexp(static_cast<double>(random_()), -32 - static_cast<int>(Pick(20)));
    return kNumbers[Pick(std::size(kNumbers))];
  }

  int Integer() {
    static constexpr int kIntegers[] = {0, 1, -1, 2, 7, 40, 1000, 1001, 4000, 100'000, 100'001, -1'000'000, 2147483647};
    return reach_ == Reach::kValues ? static_cast<int>(Pick(20)) - 5 : kIntegers[Pick(std::size(kIntegers))];
  }

  std::string Text() {
    static const std::string kTexts[] = {"",
                                         "planar",
                                         "human29",
                                         "ball",
                                         "snake",
                                         "right_foot",
                                         "left_foot",
                                         "nearest",
                                         "solves/abc",
                                         "knee_r",
                                         std::string(300, 'a'),
                                         "\n",
                                         "π",
                                         "ankle_l",
                                         "left_heel",
                                         "\"]"};
    return kTexts[Pick(std::size(kTexts))];
  }

  void MutateRepeated(google::protobuf::Message* message, const Reflection* reflection, const Field* field) {
    const int size = reflection->FieldSize(*message, field);
    const bool everything = reach_ == Reach::kEverything;
    if (everything && size > 0 && Pick(6) == 0) return reflection->RemoveLast(message, field);
    if (everything && (size == 0 || Pick(4) == 0)) return AddElement(message, reflection, field);
    if (size == 0) return;
    const int index = static_cast<int>(Pick(static_cast<size_t>(size)));
    switch (field->cpp_type()) {
      case Field::CPPTYPE_MESSAGE:
        return Mutate(reflection->MutableRepeatedMessage(message, field, index));
      case Field::CPPTYPE_DOUBLE:
        return reflection->SetRepeatedDouble(message, field, index, Number());
      case Field::CPPTYPE_STRING:
        if (everything) reflection->SetRepeatedString(message, field, index, Text());
        return;
      default:
        return;
    }
  }

  void AddElement(google::protobuf::Message* message, const Reflection* reflection, const Field* field) {
    if (field->cpp_type() == Field::CPPTYPE_MESSAGE) Mutate(reflection->AddMessage(message, field));
    if (field->cpp_type() == Field::CPPTYPE_DOUBLE) reflection->AddDouble(message, field, Number());
    if (field->cpp_type() == Field::CPPTYPE_FLOAT) reflection->AddFloat(message, field, static_cast<float>(Number()));
    if (field->cpp_type() == Field::CPPTYPE_INT32) reflection->AddInt32(message, field, Integer());
    if (field->cpp_type() == Field::CPPTYPE_STRING) reflection->AddString(message, field, Text());
  }

  void MutateSingle(google::protobuf::Message* message, const Reflection* reflection, const Field* field) {
    switch (field->cpp_type()) {
      case Field::CPPTYPE_MESSAGE:
        return Mutate(reflection->MutableMessage(message, field));
      case Field::CPPTYPE_DOUBLE:
        return reflection->SetDouble(message, field, Number());
      case Field::CPPTYPE_BOOL:
        return reflection->SetBool(message, field, Pick(2) == 0);
      case Field::CPPTYPE_INT32:
        return reflection->SetInt32(message, field, Integer());
      case Field::CPPTYPE_ENUM:
        return reflection->SetEnumValue(
            message, field, reach_ == Reach::kEverything && Pick(8) == 0 ? Integer() : static_cast<int>(Pick(5)));
      case Field::CPPTYPE_STRING:
        if (reach_ == Reach::kEverything) reflection->SetString(message, field, Text());
        return;
      default:
        return;
    }
  }

  SplitMix random_;
  const Reach reach_;
};

}  // namespace rollgait
#endif  // ROLLGAIT_TESTS_FUZZ_MESSAGE_MUTATOR_H_
