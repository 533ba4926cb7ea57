#include "server/gateway/request_message.h"

#include <google/protobuf/message.h>

#include <memory>
#include <utility>

#include "server/gateway/field_path.h"
#include "server/gateway/json.h"

namespace rollgait::server {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

Error Invalid(std::string message) { return {ErrorCode::kInvalidArgument, std::move(message)}; }

// What is wrong with the query; empty: nothing.
std::string SetQuery(const ResolvedRoute& route, std::string_view query, Message& message) {
  const std::string body = route.route->body;
  const FieldDescriptor* in_path = FindField(*message.GetDescriptor(), route.variable);
  const FieldDescriptor* in_body = message.GetDescriptor()->FindFieldByName(body);
  size_t count = 0;
  while (!query.empty()) {
    const std::string_view pair = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(query.size(), pair.size() + 1));
    if (pair.empty()) continue;
    if (++count > kMostQueryFields) return "the query has more than " + std::to_string(kMostQueryFields) + " fields";
    const size_t equals = pair.find('=');
    std::string name, value;
    if (!DecodePercent(pair.substr(0, equals), true, &name) ||
        !DecodePercent(equals == std::string_view::npos ? "" : pair.substr(equals + 1), true, &value)) {
      return "the query has a percent sign without two hexadecimal digits, or bytes that are no text in UTF-8";
    }
    const FieldDescriptor* field = FindField(*message.GetDescriptor(), name.substr(0, name.find_first_of(".[")));
    if (body == "*") return PlainText(name) + ": the fields of this request stand in its body, not in the query";
    if (field != nullptr && field == in_body) return PlainText(name) + ": stands in the body, not in the query";
    if (in_path != nullptr && FindField(*message.GetDescriptor(), name) == in_path)
      return PlainText(name) + ": stands in the path already";
    if (std::string problem = SetQueryField(message, name, value); !problem.empty()) return PlainText(problem);
  }
  return "";
}

}  // namespace

Outcome<std::string> MakeRequestMessage(const ResolvedRoute& route, const std::string& id, std::string_view query,
                                        std::string_view body, const std::string& last_event_id) {
  const auto& type = *route.method->input_type();
  const std::unique_ptr<Message> message(
      google::protobuf::MessageFactory::generated_factory()->GetPrototype(&type)->New());
  if (std::string problem = SetQuery(route, query, *message); !problem.empty()) return Invalid(std::move(problem));
  const std::string cursor = route.route->cursor, place = route.route->body;
  if (!cursor.empty() && !last_event_id.empty()) {
    message->GetReflection()->ClearField(message.get(), type.FindFieldByName(cursor));
    const std::string problem = SetQueryField(*message, cursor, last_event_id);
    if (!problem.empty())
      return Invalid("Last-Event-ID: " + PlainText(last_event_id) + " is not the number of an event");
  }
  if (!id.empty()) {
    const std::string problem = SetQueryField(*message, route.variable, route.collection + id);
    if (!problem.empty()) return Invalid(PlainText(problem));
  }
  std::string wire;
  if (place.empty() && body.find_first_not_of(" \t\r\n") != std::string_view::npos && body != "{}") {
    return Invalid("this request has no body");
  }
  if (!place.empty() && !body.empty()) {
    const FieldDescriptor* field = place == "*" ? nullptr : type.FindFieldByName(place);
    const auto& body_type = field == nullptr ? type : *field->message_type();
    const std::string problem = JsonToWire(body, body_type, &wire);
    if (!problem.empty()) return Invalid("the body is not a proto3 JSON " + body_type.name() + ": " + problem);
    if (field != nullptr) wire = WireField(field->number(), wire);
  }
  return wire + message->SerializeAsString();
}

}  // namespace rollgait::server
