#ifndef ROLLGAIT_SERVER_STORE_STATEMENT_POOL_H_
#define ROLLGAIT_SERVER_STORE_STATEMENT_POOL_H_

#include <map>
#include <memory>
#include <vector>

namespace rollgait::server {

// The statements of one connection, by the address of their literal. Statement has in_use() and MarkInUse(). One thread
// at a time.
template <typename Statement>
class StatementPool {
 public:
  // One that was not in use, and is now: made before, or the std::unique_ptr that make() returns.
  template <typename Make>
  Statement& Take(const char* sql, Make make) {
    std::vector<std::unique_ptr<Statement>>& statements = statements_[sql];
    for (const std::unique_ptr<Statement>& statement : statements) {
      if (statement->in_use()) continue;
      statement->MarkInUse();
      return *statement;
    }
    statements.push_back(make());
    statements.back()->MarkInUse();
    return *statements.back();
  }
  void Clear() { statements_.clear(); }

 private:
  std::map<const char*, std::vector<std::unique_ptr<Statement>>> statements_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_STATEMENT_POOL_H_
