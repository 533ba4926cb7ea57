#ifndef ROLLGAIT_SERVER_ACCESS_METHODS_H_
#define ROLLGAIT_SERVER_ACCESS_METHODS_H_

#include <string_view>

#include "server/access/caller.h"

namespace rollgait::server {

// What a call of a method needs and uses up.
struct MethodRule {
  const char* name;        // of GaitService
  Scope scope;             // that a token needs
  bool creates = false;    // counts towards creates_per_s
  bool watches = false;    // holds one of max_watches while it lasts
  bool changes = false;    // leaves an audit row (the store writes it)
  bool simulates = false;  // holds one of max_simulations while it lasts
};

// Every method of rollgait.v1.GaitService has a row; a test fails for one that has none.
inline constexpr MethodRule kMethodRules[] = {
    {"RunSolve", kScopeSolve, true, true, true},
    {"CreateSolve", kScopeSolve, true, false, true},
    {"BatchCreateSolves", kScopeSolve, true, false, true},
    {"WatchSolve", kScopeRead, false, true, false},
    {"WatchSolves", kScopeRead, false, true, false},
    {"GetSolve", kScopeRead},
    {"ListSolves", kScopeRead},
    {"CancelSolve", kScopeSolve, false, false, true},
    {"SetSolvePriority", kScopeSolve, true, false, true},
    {"DeleteSolve", kScopeSolve, false, false, true},
    {"ListModels", kScopeRead},
    {"GetModel", kScopeRead},
    {"CreateModel", kScopeSolve, true, false, true},
    {"DeleteModel", kScopeSolve, false, false, true},
    {"GetServerInfo", kScopeRead},
    {"Simulate", kScopeSolve, true, true, false, true},
    {"FindPeriodicGait", kScopeSolve, true, true, false, true},
};

// The rule of a method; one without a row does not compile.
consteval const MethodRule& RuleOf(std::string_view name) {
  for (const MethodRule& rule : kMethodRules) {
    if (name == rule.name) return rule;
  }
  throw "this method has no row in kMethodRules";
}

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_ACCESS_METHODS_H_
