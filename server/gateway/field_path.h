// Fields of a request by their path, as a query names them.
#ifndef ROLLGAIT_SERVER_GATEWAY_FIELD_PATH_H_
#define ROLLGAIT_SERVER_GATEWAY_FIELD_PATH_H_

#include <google/protobuf/message.h>

#include <string>
#include <string_view>
#include <vector>

namespace rollgait::server {

// The field that a path like "filter.createTimeFrom" leads to, through at most one message that is not repeated; names
// as in the .proto file or in JSON. Null: there is none.
const google::protobuf::FieldDescriptor* FindField(const google::protobuf::Descriptor& type, std::string_view path);

// Whether a query can set it: numbers, booleans, texts, enums and times, lists of these, and maps from text to them.
bool IsQueryField(const google::protobuf::FieldDescriptor& field);

// A field that a query can set, with its path in JSON names.
struct QueryField {
  std::string path;
  const google::protobuf::FieldDescriptor* field;
};
// All of them, in the order of the .proto file.
std::vector<QueryField> QueryFields(const google::protobuf::Descriptor& type);

// Sets the field that `path` names to `value`, valid UTF-8 that is read as proto3 JSON reads the string. A field that
// is repeated gets one more value; "labels.KEY" and "labels[KEY]" set one entry of a map. Returns what is wrong, empty:
// nothing. A field that is not repeated and an entry of a map are set once: a second time is refused, as is a field
// that a query cannot set.
std::string SetQueryField(google::protobuf::Message& message, std::string_view path, const std::string& value);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_GATEWAY_FIELD_PATH_H_
