// proto3 JSON and the wire format, without objects between them: what a request takes in memory is bounded by its
// length.
#ifndef ROLLGAIT_SERVER_GATEWAY_JSON_H_
#define ROLLGAIT_SERVER_GATEWAY_JSON_H_

#include <google/protobuf/message.h>

#include <string>
#include <string_view>

namespace rollgait::server {

// `json` as a message of `type` in the wire format. Returns what is wrong with it, in one line of valid UTF-8 of at
// most about 1000 bytes; empty: nothing. Unknown fields, bytes that are no UTF-8, and more than 100 levels of nesting
// are refused.
std::string JsonToWire(std::string_view json, const google::protobuf::Descriptor& type, std::string* wire);

// A message of `type` in the wire format as one line of JSON; false: it is none. Names are lowerCamelCase, fields at
// their default are left out.
bool WireToJson(const std::string& wire, const google::protobuf::Descriptor& type, std::string* json);

// `wire` as the value of a field of the type message, in the wire format.
std::string WireField(int number, const std::string& wire);

// Text in quotes. `text` must be valid UTF-8.
std::string JsonString(const std::string& text);

// One line of valid UTF-8 without control characters, cut after about 1000 bytes.
std::string PlainText(const std::string& text);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_GATEWAY_JSON_H_
