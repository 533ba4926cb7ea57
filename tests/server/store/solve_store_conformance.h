#ifndef ROLLGAIT_TESTS_SERVER_STORE_SOLVE_STORE_CONFORMANCE_H_
#define ROLLGAIT_TESTS_SERVER_STORE_SOLVE_STORE_CONFORMANCE_H_

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "server/store/sql_store.h"
#include "tests/server/store/fake_clock.h"

namespace rollgait::server {

// One kind of store. A new kind joins the suite with one INSTANTIATE_TEST_SUITE_P line in its own test file.
struct StoreKind {
  std::string name;
  // Opens the store that lies in `directory`; called twice for one directory it gives two objects on the same solves
  // and models.
  std::function<std::unique_ptr<SqlStore>(const std::string& directory, const Clock& clock)> open;
  // Lets leases age: so much time passes for the clock they expire by.
  std::function<void(const std::string& directory, FakeClock& clock, std::chrono::milliseconds time)> pass_time;
};

// The cases are in {solve_store_*,model_store}_conformance.cc.
class SolveStoreConformance : public testing::TestWithParam<StoreKind> {};

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SERVER_STORE_SOLVE_STORE_CONFORMANCE_H_
