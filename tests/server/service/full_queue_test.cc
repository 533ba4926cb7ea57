#include "server/service/full_queue.h"

#include <gtest/gtest.h>

namespace rollgait::server {
namespace {

TEST(FullQueueTest, OneTenantsLimitIsHisOwnAndTheServersIsEverybodys) {
  FullQueue queue;
  EXPECT_FALSE(queue.Refusal("a").has_value());
  queue.Note("a", {ErrorCode::kNotFound, "something else"});
  EXPECT_FALSE(queue.Refusal("a").has_value());
  Error own{ErrorCode::kResourceExhausted, "1 of a"};
  own.quota = {"tenant:a", "1 of a"};
  queue.Note("a", own);
  EXPECT_FALSE(queue.Refusal("b").has_value());
  while (queue.Refusal("a").has_value()) {  // ends by itself, or the test does not
    EXPECT_EQ(queue.Refusal("a").value_or(own).message, "1 of a");
  }
  queue.Note("a", {ErrorCode::kResourceExhausted, "1000 of all"});
  while (const std::optional<Error> refusal = queue.Refusal("b")) EXPECT_EQ(refusal->message, "1000 of all");
  EXPECT_FALSE(queue.Refusal("a").has_value());
}

}  // namespace
}  // namespace rollgait::server
