#include "server/base/digest.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

// Known answers: FIPS 180-2, appendix B.
constexpr char kEmpty[] = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
constexpr char kAbc[] = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
constexpr char kMillionA[] = "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0";

TEST(DigestTest, KnownAnswers) {
  EXPECT_EQ(Sha256Hex(""), kEmpty);
  EXPECT_EQ(Sha256Hex("abc"), kAbc);
}

TEST(DigestTest, FilesAreReadWhole) {
  const TemporaryDirectory directory;
  const std::string path = directory.path() + "/file";
  std::ofstream(path) << std::string(1'000'000, 'a');
  EXPECT_EQ(Sha256HexOfFile(path).value(), kMillionA);
  EXPECT_EQ(Sha256HexOfFile(directory.path() + "/none").error().code, ErrorCode::kUnavailable);
  EXPECT_EQ(Sha256HexOfFile(directory.path()).error().code, ErrorCode::kUnavailable);
}

TEST(DigestTest, RandomIdsDiffer) {
  std::set<std::string> ids;
  for (int i = 0; i < 100; ++i) {
    const std::string id = RandomId();
    EXPECT_EQ(id.size(), 16u);
    EXPECT_EQ(id.find_first_not_of("abcdefghijklmnopqrstuvwxyz234567"), std::string::npos) << id;
    ids.insert(id);
  }
  EXPECT_EQ(ids.size(), 100u);
}

}  // namespace
}  // namespace rollgait::server
