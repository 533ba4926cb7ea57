#ifndef ROLLGAIT_TESTS_SUPPORT_EVERY_SCHEME_H_
#define ROLLGAIT_TESTS_SUPPORT_EVERY_SCHEME_H_

#include <vector>

#include "core/math/scheme.h"

namespace rollgait {

// For ::testing::ValuesIn.
inline std::vector<Scheme> EveryScheme() {
  std::vector<Scheme> schemes;
  for (const SchemeTraits& traits : Schemes()) schemes.push_back(traits.scheme);
  return schemes;
}

// Those of collocation: the schemes of trajectories.
inline std::vector<Scheme> EveryCollocation() {
  std::vector<Scheme> schemes;
  for (const SchemeTraits& traits : Schemes()) {
    if (traits.is_collocation()) schemes.push_back(traits.scheme);
  }
  return schemes;
}

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_SUPPORT_EVERY_SCHEME_H_
