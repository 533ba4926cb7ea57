// What the client reads from files of its user: requests and scenes as proto3 JSON.
#include <sys/mman.h>
#include <unistd.h>

#include "client/failure.h"
#include "client/json.h"
#include "rollgait/v1/simulation.pb.h"
#include "rollgait/v1/solve_spec.pb.h"
#include "tests/fuzz/fuzz_target.h"

using namespace rollgait;

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned) {
  return LLVMFuzzerMutate(data, size, max_size);
}

namespace {

// A file in memory with this content; its path.
std::string FileWith(const uint8_t* data, size_t size) {
  static const int fd = memfd_create("json", MFD_CLOEXEC);
  ROLLGAIT_CHECK(fd >= 0 && ftruncate(fd, 0) == 0);
  ROLLGAIT_CHECK(pwrite(fd, data, size, 0) == static_cast<ssize_t>(size));
  return "/proc/self/fd/" + std::to_string(fd);
}

// What was read is written so that it reads the same.
template <typename Message>
void ReadAs(const std::string& path) {
  Message message, again;
  try {
    client::ReadJsonFile(path, message);
  } catch (const client::Failure& failure) {
    ROLLGAIT_CHECK(failure.what()[0] != '\0');
    return;
  }
  const std::string text = client::ToJsonLine(message);
  ROLLGAIT_CHECK(google::protobuf::util::JsonStringToMessage(text, &again).ok());
  ROLLGAIT_CHECK(client::ToJsonLine(again) == text);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string path = FileWith(data, size);
  ReadAs<v1::SolveSpec>(path);
  ReadAs<v1::SimulationScene>(path);
  return 0;
}
