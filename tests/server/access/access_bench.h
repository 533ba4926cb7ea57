#ifndef ROLLGAIT_TESTS_SERVER_ACCESS_ACCESS_BENCH_H_
#define ROLLGAIT_TESTS_SERVER_ACCESS_ACCESS_BENCH_H_

#include <memory>
#include <string>

#include "server/access/access_store.h"
#include "server/store/open_store.h"
#include "tests/server/store/fake_clock.h"
#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {

// Tokens and tenants in a new SQLite file, with a clock that the test moves.
class AccessBench {
 public:
  AccessBench()
      : store_(OpenStore(LocateStore("", directory_.path()).value(), clock_).value()),
        access_(store_->database(), clock_) {}

  FakeClock& clock() { return clock_; }
  AccessStore& access() { return access_; }
  SqlStore& store() { return *store_; }
  Token Create(const std::string& tenant, unsigned scopes = kScopeRead | kScopeSolve, int64_t lifetime_s = 0) {
    return access_.CreateToken({tenant, scopes, lifetime_s, ""}).value();
  }

 private:
  TemporaryDirectory directory_;
  FakeClock clock_;
  std::unique_ptr<SqlStore> store_;
  AccessStore access_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SERVER_ACCESS_ACCESS_BENCH_H_
