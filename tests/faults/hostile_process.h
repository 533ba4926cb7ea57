#ifndef ROLLGAIT_TESTS_FAULTS_HOSTILE_PROCESS_H_
#define ROLLGAIT_TESTS_FAULTS_HOSTILE_PROCESS_H_

#include <cstdint>
#include <map>
#include <string>

namespace rollgait::faults {

// rollgait_hostile_tenant as if it ran on another machine: scheduled as SCHED_IDLE, which any other thread that wakes
// up displaces at once. One of niceness 19 keeps its core until the next tick of the kernel, 4 ms.
class HostileProcess {
 public:
  // Calls of one kind of attack.
  struct Tally {
    int64_t served = 0, refused = 0;
  };

  // `solve` is a finished one of the tenant of the token; `only` the one attack to make, empty: all.
  HostileProcess(const std::string& address, const std::string& token_file, const std::string& solve,
                 const std::string& only);

  // Returns when all has ended. Throws.
  void Attack(double seconds);
  // Of the attacks so far, by name. One that was never served has attacked nothing.
  const std::map<std::string, Tally>& tallies() const { return tallies_; }

 private:
  const std::string command_;
  int64_t attacks_ = 0;
  std::map<std::string, Tally> tallies_;
};

}  // namespace rollgait::faults

#endif  // ROLLGAIT_TESTS_FAULTS_HOSTILE_PROCESS_H_
