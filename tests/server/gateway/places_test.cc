#include "server/gateway/places.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rollgait::server {
namespace {

using ::testing::HasSubstr;

TEST(Places, AreBoundedInAllAndOfASource) {
  const auto places = std::make_shared<Places>("long bodies", 3, 2);
  Place first = places->Take("a").value(), second = places->Take("a").value();
  EXPECT_THAT(places->Take("a").error().message, HasSubstr("2 long bodies of your address"));
  const Place third = places->Take("b").value();
  EXPECT_THAT(places->Take("c").error().message, HasSubstr("3 long bodies are"));
  const Place copy = first;
  first.reset();
  EXPECT_FALSE(places->Take("c").ok()) << "a copy holds the place";
  second.reset();
  EXPECT_TRUE(places->Take("c").ok());
  EXPECT_TRUE(places->Take("a").ok()) << "the one of c was given back";
}

TEST(Places, MayBeGivenBackLast) {
  auto places = std::make_shared<Places>("streams", 1, 1);
  const std::weak_ptr<Places> observer = places;
  Place place = places->Take("a").value();
  places.reset();
  EXPECT_FALSE(observer.expired());
  place.reset();
  EXPECT_TRUE(observer.expired());
}

}  // namespace
}  // namespace rollgait::server
