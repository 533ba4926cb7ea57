#ifndef ROLLGAIT_SERVER_BASE_FRAMING_H_
#define ROLLGAIT_SERVER_BASE_FRAMING_H_

#include <cstddef>
#include <string>
#include <string_view>

namespace rollgait::server {

// Messages on a byte stream between two of our processes. A frame is the four bytes "RGF1", the length of the payload
// as four bytes (least significant first), and the payload.

// Largest payload in bytes that either side accepts: a trajectory of the largest mesh has about a fifth of it.
inline constexpr size_t kMaxFrameBytes = size_t{256} << 20;

enum class FrameStatus {
  kOk,
  kNeedMore,   // the frame is not complete yet
  kEnd,        // the stream ended between two frames
  kTruncated,  // the stream ended within a frame
  kGarbage,    // what follows is not a frame
  kTooLarge,   // the payload is larger than the limit
  kError,      // the descriptor failed; errno says how
};

// For messages: "the stream ended within a frame".
const char* Describe(FrameStatus status);

// The payload with its header. Contract: at most kMaxFrameBytes.
std::string EncodeFrame(std::string_view payload);

// Cuts a stream that arrives in pieces into frames. One thread.
class FrameParser {
 public:
  explicit FrameParser(size_t max_payload = kMaxFrameBytes) : max_payload_(max_payload) {}

  void Append(std::string_view bytes) { buffer_.append(bytes); }
  // kOk and the next payload, kNeedMore, kGarbage or kTooLarge. After the last two the stream cannot be read on.
  FrameStatus Next(std::string* payload);
  // True if the stream may end here.
  bool AtBoundary() const { return consumed_ == buffer_.size(); }

 private:
  size_t max_payload_;
  std::string buffer_;
  size_t consumed_ = 0;  // bytes of buffer_ that were returned already
};

// Reads what there is into the parser, without waiting if the descriptor is non-blocking. kOk: something was read;
// kNeedMore: nothing there now; kEnd, kTruncated; kError. Contract: Next was called until it returned kNeedMore.
FrameStatus ReadAvailable(int fd, FrameParser* parser);

// Reads one frame, waiting for it; continues after signals. Not for use with a FrameParser on the same stream.
FrameStatus ReadFrame(int fd, std::string* payload, size_t max_payload = kMaxFrameBytes);

// Writes one frame, waiting as long as it takes; continues after signals. kOk or kError (EPIPE: nobody reads; no
// SIGPIPE on sockets).
FrameStatus WriteFrame(int fd, std::string_view payload);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_FRAMING_H_
