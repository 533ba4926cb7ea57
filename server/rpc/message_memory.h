#ifndef ROLLGAIT_SERVER_RPC_MESSAGE_MEMORY_H_
#define ROLLGAIT_SERVER_RPC_MESSAGE_MEMORY_H_

#include <google/protobuf/message.h>

#include <cstdint>

namespace rollgait::server {

// Bytes that a message takes until it is written: itself, and what gRPC makes of it.
inline int64_t MemoryOf(const google::protobuf::Message& message) {
  return static_cast<int64_t>(message.SpaceUsedLong() + message.ByteSizeLong());
}

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_RPC_MESSAGE_MEMORY_H_
