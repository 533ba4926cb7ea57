#include "server/convert/unknown_fields.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/unknown_field_set.h>

#include <string>
#include <vector>

namespace rollgait::server {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

constexpr size_t kMaxViolations = 10;

void Find(const std::string& path, const Message& message, Violations* violations) {
  const Reflection& reflection = *message.GetReflection();
  const google::protobuf::UnknownFieldSet& unknown = reflection.GetUnknownFields(message);
  for (int i = 0; i < unknown.field_count() && violations->size() < kMaxViolations; ++i) {
    violations->push_back({path, "field number " + std::to_string(unknown.field(i).number()) +
                                     " is not known to this server; leave it out or use a newer server"});
  }
  std::vector<const FieldDescriptor*> fields;
  reflection.ListFields(message, &fields);
  const std::string prefix = path.empty() ? path : path + ".";
  for (const FieldDescriptor* field : fields) {
    if (field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) continue;
    const std::string name = prefix + std::string(field->name());
    if (!field->is_repeated()) {
      Find(name, reflection.GetMessage(message, field), violations);
      continue;
    }
    for (int i = 0; i < reflection.FieldSize(message, field) && violations->size() < kMaxViolations; ++i) {
      Find(name + "[" + std::to_string(i) + "]", reflection.GetRepeatedMessage(message, field, i), violations);
    }
  }
}

}  // namespace

Violations FindUnknownFields(const Message& message) {
  Violations violations;
  Find("", message, &violations);
  return violations;
}

}  // namespace rollgait::server
