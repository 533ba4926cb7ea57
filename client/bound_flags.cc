#include "client/bound_flags.h"

#include <google/protobuf/descriptor.h>

#include <map>

#include "client/flag_values.h"

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

}  // namespace rollgait::client
