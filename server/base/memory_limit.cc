#include "server/base/memory_limit.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace rollgait::server {

int64_t MemoryLimit(const std::string& groups, const std::string& own) {
  int64_t limit = int64_t{sysconf(_SC_PHYS_PAGES)} * sysconf(_SC_PAGESIZE);
  std::ifstream file(own);
  std::string line;
  while (std::getline(file, line)) {
    if (line.rfind("0::/", 0) != 0) continue;  // the line of version 2
    const std::filesystem::path root(groups);
    for (std::filesystem::path group = std::filesystem::path(line.substr(4));; group = group.parent_path()) {
      int64_t bytes = 0;  // "max", and the root has no such file: not read
      if (std::ifstream(root / group / "memory.max") >> bytes) limit = std::min(limit, bytes);
      if (group.empty()) break;
    }
  }
  return limit;
}

}  // namespace rollgait::server
