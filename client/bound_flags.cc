#include "client/bound_flags.h"

#include <google/protobuf/descriptor.h>

#include <map>

#include "client/flag_values.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

std::map<std::string, const google::protobuf::FieldDescriptor*> BoundFields() {
  std::map<std::string, const google::protobuf::FieldDescriptor*> fields;
  const google::protobuf::Descriptor& accuracy = *v1::Accuracy::descriptor();
  for (int i = 0; i < accuracy.field_count(); ++i) {
    const google::protobuf::FieldDescriptor* field = accuracy.field(i);
    const bool is_double = field->cpp_type() == google::protobuf::FieldDescriptor::CPPTYPE_DOUBLE;
    if (is_double && field->name().rfind("max_", 0) == 0) fields[field->name()] = field;
  }
  return fields;
}

}  // namespace

std::vector<std::string> BoundNames() {
  std::vector<std::string> names;
  for (const auto& [name, field] : BoundFields()) names.push_back(name);
  return names;
}

void ApplyBounds(const std::vector<std::string>& bounds, v1::Accuracy& accuracy) {
  for (const std::string& text : bounds) {
    const auto [name, bound] = ParseAssignment("--bound", text);
    accuracy.GetReflection()->SetDouble(&accuracy, Lookup("--bound", name, BoundFields()), bound);
  }
}

void ApplyMaxErrors(const std::vector<std::string>& errors, v1::Accuracy& accuracy) {
  using Setter = void (v1::MaxError::*)(double);
  struct Word {
    Setter set;
    double factor;  // from the unit on the command line to the field's
  };
  const std::map<std::string, Word> words = {{"objective", {&v1::MaxError::set_objective, 1}},
                                             {"angle", {&v1::MaxError::set_angle_rad, kPi / 180}},
                                             {"torque", {&v1::MaxError::set_torque_n_m, 1}},
                                             {"contact-force", {&v1::MaxError::set_contact_force_n, 1}}};
  for (const std::string& text : errors) {
    const auto [name, most] = ParseAssignment("--max-error", text);
    const Word word = Lookup("--max-error", name, words);
    (accuracy.mutable_max_error()->*word.set)(word.factor * most);
  }
}

}  // namespace rollgait::client
