#ifndef ROLLGAIT_TESTS_FUZZ_FUZZ_TARGET_H_
#define ROLLGAIT_TESTS_FUZZ_FUZZ_TARGET_H_

#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

#include "core/base/check.h"
#include "core/base/result.h"
#include "tests/fuzz/field_path.h"
#include "tests/fuzz/message_mutator.h"

// Each fuzz_*.cc defines these two, which libFuzzer and driver.cc call. A broken promise aborts.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);
// Writes a changed input of at most `max_size` bytes over `data` and returns its size.
extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned seed);
// libFuzzer's and the driver's own change of bytes.
extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max_size);
// A target whose seeds are readable texts may define this: the form of a seed that changes start from. It is run as it
// is, too.
extern "C" __attribute__((weak)) size_t FuzzSeedToChange(uint8_t* data, size_t size, size_t max_size);

namespace rollgait::fuzz {

// A message from JSON (readable seeds) or from its bytes. False: neither.
inline bool ParseInput(const uint8_t* data, size_t size, google::protobuf::Message* message) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (!text.empty() && text[0] == '{') {
    return google::protobuf::util::JsonStringToMessage(std::string(text), message).ok();
  }
  return message->ParseFromArray(data, static_cast<int>(size));
}

// Changes three of four inputs as messages, the others as bytes.
template <typename Message>
size_t MutateAsMessage(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
  MessageMutator mutator(seed);
  static Message message;  // its memory is used again
  static std::string bytes;
  if (mutator.Pick(4) == 0 || !ParseInput(data, size, &message)) return LLVMFuzzerMutate(data, size, max_size);
  for (unsigned k = 1 + mutator.Pick(4); k > 0; --k) mutator.Mutate(&message);
  if (!message.SerializeToString(&bytes) || bytes.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(data));
  return bytes.size();
}

// The bytes of a message for its JSON, which takes long to read; anything else stays as it is.
template <typename Message>
size_t SeedAsBytes(uint8_t* data, size_t size, size_t max_size) {
  Message message;
  if (!ParseInput(data, size, &message) || message.ByteSizeLong() > max_size) return size;
  message.SerializeToArray(data, static_cast<int>(max_size));
  return message.ByteSizeLong();
}

// Every violation names a field of the message and says something.
inline void CheckViolations(const Violations& violations, const google::protobuf::Descriptor& type) {
  for (const Violation& violation : violations) {
    if (!NamesField(type, violation.field))
      std::fprintf(stderr, "no field of %s: %s\n", type.name().c_str(), violation.field.c_str());
    ROLLGAIT_CHECK(NamesField(type, violation.field));
    ROLLGAIT_CHECK(!violation.message.empty());
  }
}

}  // namespace rollgait::fuzz

#endif  // ROLLGAIT_TESTS_FUZZ_FUZZ_TARGET_H_
