#ifndef ROLLGAIT_TESTS_FAULTS_HOSTILE_TENANT_H_
#define ROLLGAIT_TESTS_FAULTS_HOSTILE_TENANT_H_

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tests/faults/load.h"

namespace rollgait::faults {

// A tenant that does with its token all that the service lets it do, at once, as fast as it can, and heeds no
// RetryInfo.
class HostileTenant {
 public:
  struct Options {
    std::string address, token;
    std::string token_file;    // with the same token
    std::string solve;         // "solves/{id}", a finished one of its own
    std::string only;          // the one attack to make; empty: all
    int64_t first_number = 0;  // what it asks for differs by a number, which begins here
  };
  // Of one kind of attack.
  struct Tally {
    std::string name;
    int64_t served = 0, refused = 0;
  };

  explicit HostileTenant(Options options);
  // Attacks for so many seconds, once; returns when all has ended.
  void Attack(double seconds);
  // Of the attacks so far. One that was never served has attacked nothing.
  std::vector<Tally> tallies() const;

 private:
  struct Counts {
    std::atomic<int64_t> served{0}, refused{0};
  };
  void Repeat(size_t kind);
  void LeaveUnread(const std::string& attack, double seconds);

  const Options options_;
  v1::Model model_;  // that it stores again and again
  std::atomic<bool> stopping_{false};
  std::atomic<int64_t> next_;
  std::vector<Counts> counts_;  // in the order of the table of attacks
  std::atomic<int64_t> unread_{0};
};

}  // namespace rollgait::faults

#endif  // ROLLGAIT_TESTS_FAULTS_HOSTILE_TENANT_H_
