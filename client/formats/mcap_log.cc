#include "client/formats/mcap_log.h"

#include <cmath>

namespace rollgait::client {
namespace {

constexpr char kMagic[] = "\x89MCAP0\r\n";

enum Opcode : uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kStatistics = 0x0B,
  kDataEnd = 0x0F,
};

// The lowest byte first.
template <typename Integer>
std::string Bytes(Integer value) {
  std::string bytes;
  for (size_t i = 0; i < sizeof(value); ++i) bytes += static_cast<char>(value >> (8 * i) & 255);
  return bytes;
}

std::string Prefixed(const std::string& text) { return Bytes(static_cast<uint32_t>(text.size())) + text; }

std::string Record(Opcode opcode, const std::string& content) {
  return static_cast<char>(opcode) + Bytes(static_cast<uint64_t>(content.size())) + content;
}

}  // namespace

McapLog::McapLog(const std::string& library) : bytes_(kMagic + Record(kHeader, Prefixed("") + Prefixed(library))) {}

uint16_t McapLog::AddChannel(const std::string& topic, const std::string& schema_name, const nlohmann::json& schema) {
  const uint16_t id = static_cast<uint16_t>(counts_.size() + 1);
  counts_[id] = 0;
  const std::string records =
      Record(kSchema, Bytes(id) + Prefixed(schema_name) + Prefixed("jsonschema") + Prefixed(schema.dump())) +
      Record(kChannel, Bytes(id) + Bytes(id) + Prefixed(topic) + Prefixed("json") + Bytes(uint32_t{0}));
  definitions_ += records;
  bytes_ += records;
  return id;
}

void McapLog::AddMessage(uint16_t channel, double time_s, const nlohmann::json& message) {
  const uint64_t time_ns = static_cast<uint64_t>(std::llround(1e9 * time_s));
  const uint32_t sequence = static_cast<uint32_t>(counts_.at(channel)++);
  last_ns_ = time_ns;
  bytes_ += Record(kMessage, Bytes(channel) + Bytes(sequence) + Bytes(time_ns) + Bytes(time_ns) + message.dump());
}

std::string McapLog::Finish() const {
  std::string file = bytes_ + Record(kDataEnd, Bytes(uint32_t{0}));
  const uint64_t summary_start = file.size();
  uint64_t messages = 0;
  std::string counts;
  for (const auto& [channel, count] : counts_) {
    messages += count;
    counts += Bytes(channel) + Bytes(count);
  }
  const uint32_t channels = static_cast<uint32_t>(counts_.size());
  file +=
      definitions_ + Record(kStatistics, Bytes(messages) + Bytes(static_cast<uint16_t>(channels)) + Bytes(channels) +
                                             Bytes(uint32_t{0}) + Bytes(uint32_t{0}) + Bytes(uint32_t{0}) +
                                             Bytes(first_ns_) + Bytes(last_ns_) + Prefixed(counts));
  file += Record(kFooter, Bytes(summary_start) + Bytes(uint64_t{0}) + Bytes(uint32_t{0}));
  return file + kMagic;
}

}  // namespace rollgait::client
