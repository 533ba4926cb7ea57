// Frames on a pipe, in pieces of any size.
#include "server/base/framing.h"
#include "tests/fuzz/fuzz_target.h"

using namespace rollgait;

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned) {
  return LLVMFuzzerMutate(data, size, max_size);
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  constexpr size_t kLimit = 4096;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  server::FrameParser parser(kLimit);
  std::string frames, payload;
  server::FrameStatus status = server::FrameStatus::kNeedMore;
  for (size_t begin = 0; begin < size && status == server::FrameStatus::kNeedMore;) {
    const size_t piece = std::min(size - begin, 1 + static_cast<size_t>(data[begin]) % 17);
    parser.Append(bytes.substr(begin, piece));
    begin += piece;
    while ((status = parser.Next(&payload)) == server::FrameStatus::kOk) {
      ROLLGAIT_CHECK(payload.size() <= kLimit);
      frames += server::EncodeFrame(payload);
    }
  }
  ROLLGAIT_CHECK(bytes.substr(0, frames.size()) == frames);  // what was read is what was there
  const bool whole = status == server::FrameStatus::kNeedMore && frames.size() == size;
  ROLLGAIT_CHECK(parser.AtBoundary() == whole || status != server::FrameStatus::kNeedMore);
  return 0;
}
