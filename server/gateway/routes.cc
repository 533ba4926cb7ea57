#include "server/gateway/routes.h"

#include <charconv>
#include <utility>

#include "core/base/check.h"
#include "rollgait/v1/gait_service.pb.h"
#include "server/base/utf8.h"
#include "server/gateway/field_path.h"

namespace rollgait::server {
namespace {

using google::protobuf::FieldDescriptor;

ResolvedRoute Resolve(const Route& route, const google::protobuf::ServiceDescriptor& service) {
  ResolvedRoute resolved{&route, service.FindMethodByName(route.method), route.path, "", "", ""};
  const std::string path = route.path;
  const size_t open = path.find('{'), equals = path.find('='), close = path.find("/*}");
  if (open == std::string::npos) return resolved;
  if (equals == std::string::npos || close == std::string::npos || equals < open || close < equals) {
    resolved.method = nullptr;
    return resolved;
  }
  resolved.variable = path.substr(open + 1, equals - open - 1);
  resolved.collection = path.substr(equals + 1, close + 1 - equals - 1);
  resolved.before = path.substr(0, open) + resolved.collection;
  resolved.after = path.substr(close + 3);
  return resolved;
}

// The part of `path` where the ID of the route is, still encoded; false: not a path of this route.
bool FindId(const ResolvedRoute& route, std::string_view path, std::string_view* id) {
  if (route.variable.empty()) return path == route.before;
  if (path.size() <= route.before.size() + route.after.size()) return false;
  if (path.substr(0, route.before.size()) != route.before) return false;
  if (path.substr(path.size() - route.after.size()) != route.after) return false;
  *id = path.substr(route.before.size(), path.size() - route.before.size() - route.after.size());
  return id->find_first_of("/:") == std::string_view::npos;
}

}  // namespace

std::string ResolvedRoute::MethodPath() const { return "/" + method->service()->full_name() + "/" + method->name(); }

std::string ResolvedRoute::VariableName() const {
  return collection.empty() ? "" : collection.substr(0, collection.size() - 2);
}

std::string ResolvedRoute::DocumentPath() const {
  return variable.empty() ? before : before + "{" + VariableName() + "}" + after;
}

std::string RouteProblem(const Route& route, const google::protobuf::ServiceDescriptor& service) {
  const ResolvedRoute resolved = Resolve(route, service);
  if (service.FindMethodByName(route.method) == nullptr) return std::string("there is no method ") + route.method;
  if (resolved.method == nullptr) return std::string(route.path) + ": a variable is {FIELD=COLLECTION/*}";
  const auto& request = *resolved.method->input_type();
  if (!resolved.variable.empty()) {
    const FieldDescriptor* field = FindField(request, resolved.variable);
    if (field == nullptr || field->type() != FieldDescriptor::TYPE_STRING || field->is_repeated()) {
      return request.full_name() + " has no string " + resolved.variable;
    }
  }
  const std::string body = route.body, cursor = route.cursor;
  if (!body.empty() && body != "*") {
    const FieldDescriptor* field = request.FindFieldByName(body);
    if (field == nullptr || field->type() != FieldDescriptor::TYPE_MESSAGE || field->is_repeated()) {
      return request.full_name() + " has no message " + body;
    }
  }
  if (!cursor.empty()) {
    const FieldDescriptor* field = request.FindFieldByName(cursor);
    const FieldDescriptor* sequence = resolved.method->output_type()->FindFieldByName("sequence");
    if (!resolved.streams() || field == nullptr || field->type() != FieldDescriptor::TYPE_INT64 ||
        sequence == nullptr || sequence->type() != FieldDescriptor::TYPE_INT64) {
      return std::string(route.method) + " cannot go on after " + cursor;
    }
  }
  const std::string verb = route.verb;
  if (verb != "GET" && verb != "POST" && verb != "DELETE") return "the verb " + verb + " is not answered";
  if (verb != "POST" && !body.empty()) return verb + " has no body";
  return "";
}

std::vector<ResolvedRoute> ResolveRoutes(const google::protobuf::ServiceDescriptor& service) {
  std::vector<ResolvedRoute> routes;
  for (const Route& route : kRoutes) {
    ROLLGAIT_CHECK(RouteProblem(route, service).empty());
    routes.push_back(Resolve(route, service));
  }
  return routes;
}

RouteTable::RouteTable()
    : routes_(ResolveRoutes(*v1::CreateSolveRequest::descriptor()->file()->FindServiceByName("GaitService"))) {}

RouteMatch RouteTable::Match(std::string_view verb, std::string_view path) const {
  RouteMatch match;
  for (const ResolvedRoute& route : routes_) {
    std::string_view id;
    std::string decoded;
    if (!FindId(route, path, &id) || !DecodePercent(id, false, &decoded)) continue;
    if (decoded == "." || decoded == ".." || decoded.find('/') != std::string::npos) continue;
    const std::string_view own = route.route->verb;
    const bool answers_head = own == "GET" && !route.streams();
    if (verb == own || (verb == "HEAD" && answers_head)) {
      match.route = &route;
      match.id = std::move(decoded);
      return match;
    }
    match.allowed += (match.allowed.empty() ? "" : ", ") + std::string(own);
    if (answers_head) match.allowed += ", HEAD";
  }
  return match;
}

bool DecodePercent(std::string_view text, bool plus_is_space, std::string* decoded) {
  decoded->clear();
  for (size_t i = 0; i < text.size(); ++i) {
    char byte = text[i];
    if (byte == '+' && plus_is_space) byte = ' ';
    if (text[i] == '%') {
      unsigned value = 0;
      const char* digits = text.data() + i + 1;
      if (text.size() - i < 3 || std::from_chars(digits, digits + 2, value, 16).ptr != digits + 2) return false;
      byte = static_cast<char>(value);
      i += 2;
    }
    decoded->push_back(byte);
  }
  for (size_t i = 0; i < decoded->size();) {
    const size_t length = Utf8SequenceLength(*decoded, i);
    if (length == 0 || static_cast<unsigned char>((*decoded)[i]) < ' ' || (*decoded)[i] == 0x7f) return false;
    i += length;
  }
  return true;
}

}  // namespace rollgait::server
