#include "server/gateway/event_text.h"

#include <google/protobuf/message.h>

#include <memory>

#include "server/gateway/json.h"

namespace rollgait::server {

std::optional<std::string> EventText(const ResolvedRoute& route, const std::string& wire) {
  const auto& type = *route.method->output_type();
  const std::unique_ptr<google::protobuf::Message> message(
      google::protobuf::MessageFactory::generated_factory()->GetPrototype(&type)->New());
  std::string json;
  if (!message->ParseFromString(wire) || !WireToJson(wire, type, &json)) return std::nullopt;
  const auto& reflection = *message->GetReflection();
  std::string name = "message";
  if (type.real_oneof_decl_count() > 0) {
    const auto* field = reflection.GetOneofFieldDescriptor(*message, type.oneof_decl(0));
    if (field != nullptr) name = field->json_name();
  }
  if (name == "heartbeat") return ": heartbeat\n\n";
  std::string text;
  if (*route.route->cursor != '\0') {
    text = "id: " + std::to_string(reflection.GetInt64(*message, type.FindFieldByName("sequence"))) + "\n";
  }
  return text + "event: " + name + "\ndata: " + json + "\n\n";
}

std::string EndText(const std::string& problem_json) {
  return "event: end\ndata: " + (problem_json.empty() ? "{}" : problem_json) + "\n\n";
}

}  // namespace rollgait::server
