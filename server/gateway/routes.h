// Which request of HTTP is which call of GaitService.
#ifndef ROLLGAIT_SERVER_GATEWAY_ROUTES_H_
#define ROLLGAIT_SERVER_GATEWAY_ROUTES_H_

#include <google/protobuf/descriptor.h>

#include <string>
#include <string_view>
#include <vector>

namespace rollgait::server {

struct Route {
  const char* method;  // of GaitService
  const char* verb;    // GET, POST, DELETE
  const char* path;    // "/v1/{name=solves/*}:cancel": the string field of the request that takes "solves/ID", or none
  const char* body;    // "*": the whole request; a field of it: the others come in the query; "": all do
  const char* cursor = "";  // field of the request that the number in Last-Event-ID is for
};

// Every method of rollgait.v1.GaitService has a row; a test fails for one that has none. Paths are those of AIP-127 and
// AIP-136. A method whose answer is a stream answers with server-sent events.
inline constexpr Route kRoutes[] = {
    {"RunSolve", "POST", "/v1/solves:run", "*"},
    {"CreateSolve", "POST", "/v1/solves", "*"},
    {"BatchCreateSolves", "POST", "/v1/solves:batchCreate", "*"},
    {"WatchSolve", "GET", "/v1/{name=solves/*}:watch", "", "after_sequence"},
    {"WatchSolves", "GET", "/v1/solves:watch", ""},
    {"WatchSolves", "POST", "/v1/solves:watch", "*"},
    {"GetSolve", "GET", "/v1/{name=solves/*}", ""},
    {"ListSolves", "GET", "/v1/solves", ""},
    {"CancelSolve", "POST", "/v1/{name=solves/*}:cancel", ""},
    {"SetSolvePriority", "POST", "/v1/{name=solves/*}:setPriority", "*"},
    {"DeleteSolve", "DELETE", "/v1/{name=solves/*}", ""},
    {"ListModels", "GET", "/v1/models", ""},
    {"GetModel", "GET", "/v1/{model.name=models/*}", ""},
    {"GetModel", "GET", "/v1/models:get", ""},
    {"GetModel", "POST", "/v1/models:get", "*"},
    {"CreateModel", "POST", "/v1/models", "model"},
    {"DeleteModel", "DELETE", "/v1/{name=models/*}", ""},
    {"GetServerInfo", "GET", "/v1/serverInfo", ""},
    {"Simulate", "POST", "/v1/scenes:simulate", "*"},
    {"FindPeriodicGait", "POST", "/v1/scenes:findPeriodicGait", "*"},
};

// A row with what its path and its method mean. `before` + ID + `after` is a path; without a variable `before` is it.
struct ResolvedRoute {
  const Route* route;
  const google::protobuf::MethodDescriptor* method;
  std::string before, after;
  std::string variable;    // field path, "model.name"; empty: none
  std::string collection;  // "solves/", stands before ID in the field

  bool streams() const { return method->server_streaming(); }
  std::string MethodPath() const;    // "/rollgait.v1.GaitService/GetSolve"
  std::string DocumentPath() const;  // "/v1/solves/{solve}:cancel"
  std::string VariableName() const;  // "solve"
};

// A row of a table that does not say a call of `service`: why; empty: it does. Fields must exist and have the type that
// they need.
std::string RouteProblem(const Route& route, const google::protobuf::ServiceDescriptor& service);

// All rows of kRoutes, for a service of any pool. A row with a problem ends the program: a test finds it.
std::vector<ResolvedRoute> ResolveRoutes(const google::protobuf::ServiceDescriptor& service);

struct RouteMatch {
  const ResolvedRoute* route = nullptr;  // null: no row has this path and verb
  std::string id;                        // percent signs decoded; the variable's value is route->collection + id
  std::string allowed;  // without a route: verbs of the rows with this path, "GET, HEAD, DELETE"; empty: none
};

// All rows of kRoutes. Immutable; threads may share it.
class RouteTable {
 public:
  RouteTable();
  // `path` as it came, without the query. An ID is one segment that is valid UTF-8 without control characters, and
  // neither "." nor ".."; other paths are no row's. HEAD is answered by the rows of GET, but by no stream, which would
  // begin for nothing.
  RouteMatch Match(std::string_view verb, std::string_view path) const;
  const std::vector<ResolvedRoute>& routes() const { return routes_; }

 private:
  std::vector<ResolvedRoute> routes_;
};

// Text with %XX replaced by its byte, and with '+' by a space if `plus_is_space`. False: a percent sign without two
// hexadecimal digits, or the result is not valid UTF-8 or has control characters.
bool DecodePercent(std::string_view text, bool plus_is_space, std::string* decoded);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_GATEWAY_ROUTES_H_
