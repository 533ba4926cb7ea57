#include "server/service/label_check.h"

#include <gtest/gtest.h>

namespace rollgait::server {
namespace {

using LabelMap = google::protobuf::Map<std::string, std::string>;

Violations FaultsOf(const std::string& key, const std::string& value) {
  Violations violations;
  LabelMap labels;
  labels[key] = value;
  ReadLabels(labels, kMostLabels, "", &violations);
  return violations;
}

TEST(LabelCheckTest, KeysAndValuesWithinTheirLimitsAreRead) {
  for (const std::string& key : {std::string("a"), std::string("sweep-2_b"), std::string(32, 'z')}) {
    for (const std::string& value : {std::string("x"), std::string(64, '~'), std::string("a = \"b\" c")}) {
      EXPECT_TRUE(FaultsOf(key, value).empty()) << key << " " << value;
    }
  }
}

TEST(LabelCheckTest, OthersAreRefusedByFieldValueAndLimit) {
  for (const std::string& key :
       {std::string(), std::string("A"), std::string("1a"), std::string("-a"), std::string("a b"), std::string("a="),
        std::string(33, 'a'), std::string("\xc3\xa9")}) {
    const Violations faults = FaultsOf(key, "v");
    ASSERT_EQ(faults.size(), 1u) << key;
    EXPECT_EQ(faults[0].field, "labels[\"" + key + "\"]");
    EXPECT_NE(faults[0].message.find("31"), std::string::npos) << faults[0].message;
  }
  EXPECT_NE(FaultsOf("a", "").at(0).message.find("from 1 to 64"), std::string::npos);
  EXPECT_NE(FaultsOf("a", std::string(65, 'v')).at(0).message.find("65 characters"), std::string::npos);
  EXPECT_NE(FaultsOf("a", "line\nend").at(0).message.find("byte 10"), std::string::npos);
}

TEST(LabelCheckTest, MoreThanTheMostAreRefused) {
  LabelMap labels;
  for (size_t i = 0; i < kMostLabels; ++i) labels["k" + std::to_string(i)] = "v";
  Violations violations;
  EXPECT_EQ(ReadLabels(labels, kMostLabels, "", &violations).size(), kMostLabels);
  EXPECT_TRUE(violations.empty());
  labels["one_more"] = "v";
  ReadLabels(labels, kMostLabels, "filter.", &violations);
  ASSERT_EQ(violations.size(), 1u);
  EXPECT_EQ(violations[0].field, "filter.labels");
  EXPECT_EQ(violations[0].message, "are 17, at most 16 are allowed");
}

}  // namespace
}  // namespace rollgait::server
