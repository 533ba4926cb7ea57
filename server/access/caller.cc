#include "server/access/caller.h"

#include <sstream>

namespace rollgait::server {
namespace {

struct NamedScope {
  Scope scope;
  const char* name;
};
constexpr NamedScope kNamed[] = {{kScopeRead, "read"}, {kScopeSolve, "solve"}, {kScopeAdmin, "admin"}};

}  // namespace

std::string ScopeNames(unsigned scopes) {
  std::string names;
  for (const NamedScope& named : kNamed) {
    if ((scopes & named.scope) != 0) names += (names.empty() ? "" : ",") + std::string(named.name);
  }
  return names;
}

std::optional<unsigned> ParseScopes(const std::string& names) {
  std::istringstream stream(names);
  unsigned scopes = 0;
  for (std::string name; std::getline(stream, name, ',');) {
    unsigned found = 0;
    for (const NamedScope& named : kNamed) found |= name == named.name ? static_cast<unsigned>(named.scope) : 0u;
    if (found == 0) return std::nullopt;
    scopes |= found;
  }
  if (scopes == 0) return std::nullopt;
  return scopes;
}

}  // namespace rollgait::server
