#ifndef ROLLGAIT_TESTS_FUZZ_SPLIT_MIX_H_
#define ROLLGAIT_TESTS_FUZZ_SPLIT_MIX_H_

#include <cstdint>

namespace rollgait {

// SplitMix64, the upper half of its numbers. Ready at once: for generators that live for one change.
class SplitMix {
 public:
  explicit SplitMix(uint64_t seed) : state_(seed) {}
  uint32_t operator()() {
    uint64_t mixed = state_ += 0x9e3779b97f4a7c15;
    mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9;
    mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111eb;
    return static_cast<uint32_t>(mixed >> 32);
  }

 private:
  uint64_t state_;
};

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_FUZZ_SPLIT_MIX_H_
