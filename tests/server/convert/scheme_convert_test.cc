#include "server/convert/scheme_convert.h"

#include <gtest/gtest.h>

namespace rollgait {
namespace {

// The table of schemes and the enumeration of the proto have the same entries.
TEST(SchemeConvert, EveryEnumeratorIsARowAndEveryRowAnEnumerator) {
  const auto* enumerators = v1::Discretization::Scheme_descriptor();
  EXPECT_EQ(enumerators->value_count(), static_cast<int>(Schemes().size()) + 1) << "and SCHEME_UNSPECIFIED";
  for (const SchemeTraits& traits : Schemes()) {
    EXPECT_EQ(&TraitsOf(traits.scheme), &traits) << traits.word << ": rows are in the order of the enumeration";
    EXPECT_EQ(DecodeScheme(EncodeScheme(traits.scheme)), traits.scheme) << traits.word;
  }
  EXPECT_FALSE(DecodeScheme(v1::Discretization::SCHEME_UNSPECIFIED).has_value());
}

}  // namespace
}  // namespace rollgait
