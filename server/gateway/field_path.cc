#include "server/gateway/field_path.h"

#include <google/protobuf/util/json_util.h>

#include <memory>

#include "server/gateway/json.h"

namespace rollgait::server {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

const FieldDescriptor* Child(const Descriptor& type, std::string_view name) {
  for (int i = 0; i < type.field_count(); ++i) {
    if (type.field(i)->name() == name || type.field(i)->json_name() == name) return type.field(i);
  }
  return nullptr;
}

bool IsTime(const FieldDescriptor& field) {
  return field.type() == FieldDescriptor::TYPE_MESSAGE &&
         field.message_type()->full_name() == "google.protobuf.Timestamp";
}

bool IsScalar(const FieldDescriptor& field) {
  return IsTime(field) || (field.type() != FieldDescriptor::TYPE_MESSAGE &&
                           field.type() != FieldDescriptor::TYPE_GROUP && field.type() != FieldDescriptor::TYPE_BYTES);
}

bool LeadsOn(const FieldDescriptor& field) {
  return field.type() == FieldDescriptor::TYPE_MESSAGE && !field.is_repeated() && !IsTime(field);
}

// A path, and the key of a map behind it.
struct SplitPath {
  std::string path, key;
  bool has_key = false;
};

// "filter.labels[a]" and "filter.labels.a" have the key "a".
SplitPath Split(const Descriptor& type, std::string_view path) {
  if (const size_t bracket = path.find('['); bracket != std::string_view::npos && path.back() == ']') {
    return {std::string(path.substr(0, bracket)), std::string(path.substr(bracket + 1, path.size() - bracket - 2)),
            true};
  }
  for (size_t dot = path.find('.'); dot != std::string_view::npos; dot = path.find('.', dot + 1)) {
    const FieldDescriptor* field = FindField(type, path.substr(0, dot));
    if (field != nullptr && field->is_map()) {
      return {std::string(path.substr(0, dot)), std::string(path.substr(dot + 1)), true};
    }
  }
  return {std::string(path), "", false};
}

// proto3 JSON of a value that stands in a query. Numbers, booleans and enums may be quoted, but booleans.
std::string JsonValue(const FieldDescriptor& field, const std::string& value) {
  return field.type() == FieldDescriptor::TYPE_BOOL && (value == "true" || value == "false") ? value
                                                                                             : JsonString(value);
}

// Why FindField finds nothing at `path`: the first name that does not exist, or the message where a query's paths end.
std::string WhyNotFound(const Descriptor& type, std::string_view path) {
  const Descriptor* owner = &type;
  while (true) {
    const size_t dot = path.find('.');
    const std::string name(path.substr(0, dot));
    const FieldDescriptor* field = Child(*owner, name);
    if (field == nullptr) return owner->name() + " has no field " + name;
    if (dot == std::string_view::npos) {
      return "cannot be set in a query, whose paths go through one message at most; requests with a body can have it";
    }
    if (field->is_repeated() || field->type() != FieldDescriptor::TYPE_MESSAGE || IsTime(*field)) {
      return name + " has no fields that a query can set";
    }
    owner = field->message_type();
    path.remove_prefix(dot + 1);
  }
}

}  // namespace

const FieldDescriptor* FindField(const Descriptor& type, std::string_view path) {
  const size_t dot = path.find('.');
  const FieldDescriptor* field = Child(type, path.substr(0, dot));
  if (field == nullptr || dot == std::string_view::npos) return field;
  return LeadsOn(*field) ? Child(*field->message_type(), path.substr(dot + 1)) : nullptr;
}

bool IsQueryField(const FieldDescriptor& field) {
  if (!field.is_map()) return IsScalar(field);
  const Descriptor& entry = *field.message_type();
  return entry.map_key()->type() == FieldDescriptor::TYPE_STRING && IsScalar(*entry.map_value());
}

std::vector<QueryField> QueryFields(const Descriptor& type) {
  std::vector<QueryField> fields;
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor& field = *type.field(i);
    if (IsQueryField(field)) fields.push_back({field.json_name(), &field});
    if (!LeadsOn(field)) continue;
    for (int j = 0; j < field.message_type()->field_count(); ++j) {
      const FieldDescriptor& inner = *field.message_type()->field(j);
      if (IsQueryField(inner)) fields.push_back({field.json_name() + "." + inner.json_name(), &inner});
    }
  }
  return fields;
}

std::string SetQueryField(Message& message, std::string_view path, const std::string& value) {
  const std::string shown(path);
  const SplitPath split = Split(*message.GetDescriptor(), path);
  const FieldDescriptor* field = FindField(*message.GetDescriptor(), split.path);
  if (field == nullptr) return shown + ": " + WhyNotFound(*message.GetDescriptor(), split.path);
  if (!IsQueryField(*field) || field->is_map() != split.has_key) {
    return shown + ": cannot be set in a query; " +
           (field->is_map() ? "of a map one entry is, " + split.path + "[KEY]=VALUE" : "it is no single value");
  }
  Message* owner = &message;
  if (const size_t dot = split.path.find('.'); dot != std::string::npos) {
    owner =
        message.GetReflection()->MutableMessage(&message, Child(*message.GetDescriptor(), split.path.substr(0, dot)));
  }
  const auto& reflection = *owner->GetReflection();
  // Presence is not known of every field: one that was set to its default and is set again is not noticed, and harms
  // nobody.
  if (!field->is_repeated() && reflection.HasField(*owner, field)) return shown + ": is given twice";
  const FieldDescriptor& kind = field->is_map() ? *field->message_type()->map_value() : *field;
  std::string json = JsonValue(kind, value);
  if (field->is_map()) {
    json = "{" + JsonString(split.key) + ":" + json + "}";
  } else if (field->is_repeated()) {
    json = "[" + json + "]";
  }
  const std::unique_ptr<Message> read(owner->New());
  const auto status =
      google::protobuf::util::JsonStringToMessage("{" + JsonString(field->json_name()) + ":" + json + "}", read.get());
  if (!status.ok()) return shown + "=" + value + ": " + PlainText(status.message().ToString());
  const int entries = field->is_map() ? reflection.FieldSize(*owner, field) : 0;
  owner->MergeFrom(*read);
  if (field->is_map() && reflection.FieldSize(*owner, field) == entries) return shown + ": is given twice";
  return "";
}

}  // namespace rollgait::server
