#ifndef ROLLGAIT_TESTS_SUPPORT_ALLOCATION_COUNTER_H_
#define ROLLGAIT_TESTS_SUPPORT_ALLOCATION_COUNTER_H_

namespace rollgait {

// Blocks that this program has asked for so far, by operator new or by malloc (Eigen's way). Only in programs that link
// rollgait::allocation_counter.
long Allocations();

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_SUPPORT_ALLOCATION_COUNTER_H_
