#include "server/gateway/openapi.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/base/check.h"
#include "server/gateway/field_path.h"
#include "server/gateway/routes.h"

namespace rollgait::server {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::EnumDescriptor;
using google::protobuf::FieldDescriptor;
using Json = nlohmann::ordered_json;

// The comments before and behind a declaration, as one paragraph a blank line.
template <typename Declaration>
std::string Comment(const Declaration& declaration) {
  google::protobuf::SourceLocation location;
  if (!declaration.GetSourceLocation(&location)) return "";
  std::string text;
  for (const std::string& part : {location.leading_comments, location.trailing_comments}) {
    for (size_t begin = 0; begin < part.size();) {
      const size_t end = std::min(part.find('\n', begin), part.size());
      std::string line = part.substr(begin, end - begin);
      line.erase(0, line.find_first_not_of(' '));
      if (!line.empty()) text += (text.empty() ? "" : " ") + line;
      begin = end + 1;
    }
  }
  return text;
}

// What the document refers to, message by message, as it is met.
class Schemas {
 public:
  Json Ref(const Descriptor& type) {
    const std::string& name = type.full_name();
    if (name == "google.protobuf.Timestamp") return {{"type", "string"}, {"format", "date-time"}};
    if (name == "google.protobuf.Empty") return {{"type", "object"}};
    return RefTo(type, [&] { return Object(type); });
  }
  Json Ref(const EnumDescriptor& type) {
    return RefTo(type, [&] { return Values(type); });
  }

  // Of a field without its comment.
  Json Field(const FieldDescriptor& field) {
    if (field.is_map()) {
      return {{"type", "object"}, {"additionalProperties", Single(*field.message_type()->map_value())}};
    }
    return field.is_repeated() ? Json{{"type", "array"}, {"items", Single(field)}} : Single(field);
  }

  // By name; made with all that they refer to.
  const std::map<std::string, Json>& all() const { return all_; }

 private:
  template <typename Type, typename Make>
  Json RefTo(const Type& type, Make make) {
    const std::string& package = type.file()->package();
    const std::string name = type.full_name().substr(package.size() + 1);
    if (all_.emplace(name, Json()).second) {
      Json schema = make();
      all_[name] = std::move(schema);
    }
    return {{"$ref", "#/components/schemas/" + name}};
  }

  Json Single(const FieldDescriptor& field) {
    switch (field.cpp_type()) {
      case FieldDescriptor::CPPTYPE_INT32:
      case FieldDescriptor::CPPTYPE_UINT32:
        return {{"type", "integer"}, {"format", "int32"}};
      case FieldDescriptor::CPPTYPE_INT64:
      case FieldDescriptor::CPPTYPE_UINT64:
        return {{"type", "string"}, {"format", "int64"}};
      case FieldDescriptor::CPPTYPE_DOUBLE:
        return {{"type", "number"}, {"format", "double"}};
      case FieldDescriptor::CPPTYPE_FLOAT:
        return {{"type", "number"}, {"format", "float"}};
      case FieldDescriptor::CPPTYPE_BOOL:
        return {{"type", "boolean"}};
      case FieldDescriptor::CPPTYPE_ENUM:
        return Ref(*field.enum_type());
      case FieldDescriptor::CPPTYPE_MESSAGE:
        return Ref(*field.message_type());
      case FieldDescriptor::CPPTYPE_STRING:
        break;
    }
    const bool is_text = field.type() == FieldDescriptor::TYPE_STRING;
    return is_text ? Json{{"type", "string"}} : Json{{"type", "string"}, {"format", "byte"}};
  }

  Json Object(const Descriptor& type) {
    Json schema = {{"type", "object"}};
    if (const std::string text = Comment(type); !text.empty()) schema["description"] = text;
    Json properties = Json::object();
    for (int i = 0; i < type.field_count(); ++i) {
      const FieldDescriptor& field = *type.field(i);
      Json property = Field(field);
      std::string text = Comment(field);
      if (field.real_containing_oneof() != nullptr) {
        text = "One of `" + field.containing_oneof()->name() + "`." + (text.empty() ? "" : " " + text);
      }
      // Beside a reference nothing else counts.
      if (!text.empty() && property.contains("$ref")) property = Json{{"allOf", Json::array({property})}};
      if (!text.empty()) property["description"] = text;
      properties[field.json_name()] = std::move(property);
    }
    schema["properties"] = std::move(properties);
    schema["additionalProperties"] = false;
    return schema;
  }

  static Json Values(const EnumDescriptor& type) {
    Json schema = {{"type", "string"}};
    std::string text = Comment(type);
    for (int i = 0; i < type.value_count(); ++i) {
      schema["enum"].push_back(type.value(i)->name());
      const std::string meaning = Comment(*type.value(i));
      if (!meaning.empty()) text += (text.empty() ? "" : "\n") + ("* `" + type.value(i)->name() + "`: " + meaning);
    }
    if (!text.empty()) schema["description"] = text;
    return schema;
  }

  std::map<std::string, Json> all_;
};

Json Parameters(const ResolvedRoute& route, Schemas& schemas) {
  Json parameters = Json::array();
  const Descriptor& type = *route.method->input_type();
  const std::string body = route.route->body;
  if (!route.variable.empty()) {
    parameters.push_back({{"name", route.VariableName()},
                          {"in", "path"},
                          {"required", true},
                          {"description", "What follows `" + route.collection + "` in `" + route.variable + "`."},
                          {"schema", {{"type", "string"}}}});
  }
  if (body == "*") return parameters;
  const FieldDescriptor* in_path = FindField(type, route.variable);
  for (const QueryField& query : QueryFields(type)) {
    const bool in_body = !body.empty() && FindField(type, query.path.substr(0, query.path.find('.')))->name() == body;
    if (in_body || query.field == in_path) continue;
    Json parameter = {{"name", query.path}, {"in", "query"}};
    if (query.field->is_map()) parameter["style"] = "deepObject";
    if (query.field->is_map() || query.field->is_repeated()) parameter["explode"] = true;
    if (const std::string text = Comment(*query.field); !text.empty()) parameter["description"] = text;
    parameter["schema"] = schemas.Field(*query.field);
    parameters.push_back(std::move(parameter));
  }
  if (*route.route->cursor != '\0') {
    parameters.push_back({{"name", "Last-Event-ID"},
                          {"in", "header"},
                          {"description", std::string("The id of the newest event that was read; counts as `") +
                                              type.FindFieldByName(route.route->cursor)->json_name() + "`."},
                          {"schema", {{"type", "string"}, {"format", "int64"}}}});
  }
  return parameters;
}

Json Operation(const ResolvedRoute& route, const std::string& id, Schemas& schemas) {
  Json operation = {{"operationId", id}, {"description", Comment(*route.method)}};
  Json parameters = Parameters(route, schemas);
  if (!parameters.empty()) operation["parameters"] = std::move(parameters);
  const Descriptor& request = *route.method->input_type();
  if (const std::string body = route.route->body; !body.empty()) {
    const Descriptor& type = body == "*" ? request : *request.FindFieldByName(body)->message_type();
    operation["requestBody"] = {{"required", true},
                                {"content", {{"application/json", {{"schema", schemas.Ref(type)}}}}}};
  }
  const Json answer = schemas.Ref(*route.method->output_type());
  Json good = {{"description", "The answer."}, {"content", {{"application/json", {{"schema", answer}}}}}};
  if (route.streams()) {
    good = {
        {"description", "Server-sent events. `event` names the field of the message's oneof, `data` is the message: " +
                            answer["$ref"].get<std::string>() + ". The last one is `end`: {} or an Error."},
        {"content", {{"text/event-stream", {{"schema", {{"type", "string"}}}}}}}};
  }
  operation["responses"] = {{"200", good}};
  if (route.streams())
    operation["responses"]["204"] = {{"description", "The stream has ended; nothing more will come."}};
  operation["responses"]["default"] = {
      {"description", "An error."},
      {"content", {{"application/json", {{"schema", {{"$ref", "#/components/schemas/Error"}}}}}}}};
  return operation;
}

Json ErrorSchema() {
  return {
      {"type", "object"},
      {"description", "Why a request was not answered (AIP-193)."},
      {"properties",
       {{"error",
         {{"type", "object"},
          {"properties",
           {{"code", {{"type", "integer"}, {"description", "The HTTP status."}}},
            {"status", {{"type", "string"}, {"description", "The code of google.rpc.Code, for example NOT_FOUND."}}},
            {"message", {{"type", "string"}}},
            {"details",
             {{"type", "array"},
              {"description", "google.rpc.BadRequest, QuotaFailure, RetryInfo and the like; `@type` says which."},
              {"items", {{"type", "object"}}}}}}},
          {"required", {"code", "status", "message"}}}}}},
      {"required", {"error"}}};
}

}  // namespace

std::string MakeOpenApi(const google::protobuf::DescriptorPool& pool, const std::string& version) {
  const auto* service = pool.FindServiceByName("rollgait.v1.GaitService");
  ROLLGAIT_CHECK(service != nullptr);
  Schemas schemas;
  Json paths = Json::object();
  std::map<std::string, int> count;
  for (const ResolvedRoute& route : ResolveRoutes(*service)) {
    const int number = ++count[route.route->method];
    const std::string id = route.route->method + (number == 1 ? "" : std::to_string(number));
    std::string verb = route.route->verb;
    for (char& letter : verb) letter = static_cast<char>(std::tolower(letter));
    paths[route.DocumentPath()][verb] = Operation(route, id, schemas);
  }
  Json components = {{"securitySchemes", {{"token", {{"type", "http"}, {"scheme", "bearer"}}}}}};
  for (const auto& [name, schema] : schemas.all()) components["schemas"][name] = schema;
  components["schemas"]["Error"] = ErrorSchema();
  const Json document = {{"openapi", "3.0.3"},
                         {"info", {{"title", "Rollgait"}, {"version", version}, {"description", Comment(*service)}}},
                         {"security", Json::array({Json::object(), Json{{"token", Json::array()}}})},
                         {"paths", paths},
                         {"components", components}};
  return document.dump(1) + "\n";
}

}  // namespace rollgait::server
