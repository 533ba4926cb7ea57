#include "server/base/iterate_files.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

TEST(IterateFilesTest, KeepsTheNewestOnly) {
  const TemporaryDirectory directory;
  const IterateFiles writer(directory.path() + "/iterates"), reader(directory.path() + "/iterates");
  IterateFiles::Version version;
  EXPECT_FALSE(reader.ReadNewer("a", &version)) << "there is no directory";
  EXPECT_TRUE(reader.Owners().empty());
  ASSERT_TRUE(writer.MakeDirectory().ok());
  ASSERT_TRUE(writer.MakeDirectory().ok()) << "it is there";
  for (const char* content : {"first", "second", "third"}) {
    ASSERT_TRUE(writer.Put("a", content).ok());
    EXPECT_EQ(reader.ReadNewer("a", &version), content);
    EXPECT_FALSE(reader.ReadNewer("a", &version)) << "that one is known";
  }
  IterateFiles::Version other;
  EXPECT_EQ(reader.ReadNewer("a", &other), "third");
  EXPECT_FALSE(reader.ReadNewer("b", &other));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory.path() + "/iterates"), {}), 1);
  EXPECT_EQ(reader.Owners(), std::vector<std::string>{"a"});
  writer.Remove("a");
  EXPECT_FALSE(reader.ReadNewer("a", &other));
  EXPECT_TRUE(reader.Owners().empty());
}

TEST(IterateFilesTest, RefusesWhatIsTooLong) {
  const TemporaryDirectory directory;
  const IterateFiles files(directory.path());
  const std::string longest(kMaxIterateBytes, 'x');
  ASSERT_TRUE(files.Put("a", longest).ok());
  const Outcome<Done> refused = files.Put("a", longest + "x");
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(refused.error().message, "an iterate has 65537 bytes; at most 65536 are shown");
  IterateFiles::Version version;
  EXPECT_EQ(files.ReadNewer("a", &version), longest);
}

TEST(IterateFilesTest, SaysWhyItCannotWrite) {
  const TemporaryDirectory directory;
  const IterateFiles files(directory.path() + "/gone");
  const Outcome<Done> put = files.Put("a", "content");
  ASSERT_FALSE(put.ok());
  EXPECT_EQ(put.error().code, ErrorCode::kUnavailable);
  EXPECT_NE(put.error().message.find("No such file or directory"), std::string::npos) << put.error().message;
}

}  // namespace
}  // namespace rollgait::server
