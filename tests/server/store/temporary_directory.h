#ifndef ROLLGAIT_TESTS_SERVER_STORE_TEMPORARY_DIRECTORY_H_
#define ROLLGAIT_TESTS_SERVER_STORE_TEMPORARY_DIRECTORY_H_

#include <cstdlib>
#include <filesystem>
#include <string>

#include "core/base/check.h"

namespace rollgait::server {

// A new empty directory, removed with all it holds at the end.
class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    std::string name = (std::filesystem::temp_directory_path() / "rollgait-test-XXXXXX").string();
    ROLLGAIT_CHECK(mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  ~TemporaryDirectory() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SERVER_STORE_TEMPORARY_DIRECTORY_H_
