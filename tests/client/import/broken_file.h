// Files that a reader must refuse with file, element and reason.
#ifndef ROLLGAIT_TESTS_CLIENT_IMPORT_BROKEN_FILE_H_
#define ROLLGAIT_TESTS_CLIENT_IMPORT_BROKEN_FILE_H_

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "client/failure.h"
#include "client/import/tree_file.h"

namespace rollgait::client {

struct BrokenFile {
  const char* name;
  std::string text;
  std::string says;
};

inline std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

inline void ExpectRefused(const std::string& path, const BrokenFile& broken) {
  try {
    ReadLinkTreeText(path, broken.text);
    FAIL() << "read";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kUsage);
    EXPECT_THAT(failure.what(), testing::StartsWith(path));
    EXPECT_THAT(failure.what(), testing::HasSubstr(broken.says));
    EXPECT_LT(std::string(failure.what()).size(), 1000u) << "repeats what it was given";
    std::printf("%s\n", failure.what());
  }
}

}  // namespace rollgait::client

#endif  // ROLLGAIT_TESTS_CLIENT_IMPORT_BROKEN_FILE_H_
