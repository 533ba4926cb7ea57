#include "server/base/framing.h"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>

#include "core/base/check.h"

namespace rollgait::server {
namespace {

constexpr std::string_view kMagic = "RGF1";
constexpr size_t kHeaderBytes = 8;

uint32_t DecodeLength(const char* bytes) {
  uint32_t length = 0;
  for (int i = 3; i >= 0; --i) length = length << 8 | static_cast<unsigned char>(bytes[i]);
  return length;
}

// Checks as much of a header as is there; sets the length once it is complete.
FrameStatus CheckHeader(std::string_view bytes, size_t max_payload, size_t* length) {
  const size_t compared = std::min(bytes.size(), kMagic.size());
  if (bytes.substr(0, compared) != kMagic.substr(0, compared)) return FrameStatus::kGarbage;
  if (bytes.size() < kHeaderBytes) return FrameStatus::kNeedMore;
  *length = DecodeLength(bytes.data() + kMagic.size());
  return *length <= max_payload ? FrameStatus::kOk : FrameStatus::kTooLarge;
}

// Bytes read, 0 at the end, -1 on failure.
ssize_t ReadSome(int fd, char* buffer, size_t size) {
  while (true) {
    const ssize_t count = read(fd, buffer, size);
    if (count >= 0 || errno != EINTR) return count;
  }
}

// kOk once `size` bytes are there, kEnd if there is none at all, kTruncated if there are some, kError.
FrameStatus ReadExactly(int fd, char* buffer, size_t size) {
  size_t done = 0;
  while (done < size) {
    const ssize_t count = ReadSome(fd, buffer + done, size - done);
    if (count < 0) return FrameStatus::kError;
    if (count == 0) return done == 0 ? FrameStatus::kEnd : FrameStatus::kTruncated;
    done += static_cast<size_t>(count);
  }
  return FrameStatus::kOk;
}

// Writes to a socket without SIGPIPE, to anything else (a file, a pipe) plainly.
ssize_t WriteSome(int fd, const char* bytes, size_t size) {
  while (true) {
    ssize_t count = send(fd, bytes, size, MSG_NOSIGNAL);
    if (count < 0 && errno == ENOTSOCK) count = write(fd, bytes, size);
    if (count >= 0 || errno != EINTR) return count;
  }
}

}  // namespace

const char* Describe(FrameStatus status) {
  switch (status) {
    case FrameStatus::kOk:
      return "a frame was read";
    case FrameStatus::kNeedMore:
      return "the frame is not complete yet";
    case FrameStatus::kEnd:
      return "the stream ended";
    case FrameStatus::kTruncated:
      return "the stream ended within a frame";
    case FrameStatus::kGarbage:
      return "the stream holds bytes that are not a frame";
    case FrameStatus::kTooLarge:
      return "a frame is larger than the limit";
    case FrameStatus::kError:
      return "the stream cannot be read or written";
  }
  ROLLGAIT_CHECK(false);
}

std::string EncodeFrame(std::string_view payload) {
  ROLLGAIT_CHECK(payload.size() <= kMaxFrameBytes);
  std::string frame(kMagic);
  frame.reserve(kHeaderBytes + payload.size());
  for (int i = 0; i < 4; ++i) frame.push_back(static_cast<char>(payload.size() >> (8 * i) & 0xff));
  frame.append(payload);
  return frame;
}

FrameStatus FrameParser::Next(std::string* payload) {
  const std::string_view rest = std::string_view(buffer_).substr(consumed_);
  size_t length = 0;
  const FrameStatus status = CheckHeader(rest, max_payload_, &length);
  if (status != FrameStatus::kOk) return status;
  if (rest.size() < kHeaderBytes + length) return FrameStatus::kNeedMore;
  payload->assign(rest.substr(kHeaderBytes, length));
  consumed_ += kHeaderBytes + length;
  if (consumed_ == buffer_.size() || consumed_ > buffer_.size() / 2) {
    buffer_.erase(0, consumed_);
    consumed_ = 0;
  }
  return FrameStatus::kOk;
}

FrameStatus ReadAvailable(int fd, FrameParser* parser) {
  // Bounded, so that a talkative peer cannot keep a poll loop busy.
  constexpr int kMaxReads = 64;
  std::array<char, 65536> buffer;
  for (int i = 0; i < kMaxReads; ++i) {
    const ssize_t count = ReadSome(fd, buffer.data(), buffer.size());
    if (count == 0 && i > 0)
      return FrameStatus::kOk;  // the caller parses first; the end is found again by the next call
    if (count == 0) return parser->AtBoundary() ? FrameStatus::kEnd : FrameStatus::kTruncated;
    if (count < 0) {
      const bool later = errno == EAGAIN || errno == EWOULDBLOCK;
      if (!later) return FrameStatus::kError;
      return i == 0 ? FrameStatus::kNeedMore : FrameStatus::kOk;
    }
    parser->Append({buffer.data(), static_cast<size_t>(count)});
    if (static_cast<size_t>(count) < buffer.size()) return FrameStatus::kOk;
  }
  return FrameStatus::kOk;
}

FrameStatus ReadFrame(int fd, std::string* payload, size_t max_payload) {
  std::array<char, kHeaderBytes> header;
  FrameStatus status = ReadExactly(fd, header.data(), header.size());
  if (status != FrameStatus::kOk) return status;
  size_t length = 0;
  status = CheckHeader({header.data(), header.size()}, max_payload, &length);
  if (status != FrameStatus::kOk) return status;
  payload->resize(length);
  status = ReadExactly(fd, payload->data(), length);
  return status == FrameStatus::kEnd ? FrameStatus::kTruncated : status;
}

FrameStatus WriteFrame(int fd, std::string_view payload) {
  const std::string frame = EncodeFrame(payload);
  size_t done = 0;
  while (done < frame.size()) {
    const ssize_t count = WriteSome(fd, frame.data() + done, frame.size() - done);
    if (count < 0) return FrameStatus::kError;
    done += static_cast<size_t>(count);
  }
  return FrameStatus::kOk;
}

}  // namespace rollgait::server
