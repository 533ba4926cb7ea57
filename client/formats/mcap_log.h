// The container of MCAP: records without chunks, compression or checksums, then a summary.
#ifndef ROLLGAIT_CLIENT_FORMATS_MCAP_LOG_H_
#define ROLLGAIT_CLIENT_FORMATS_MCAP_LOG_H_

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace rollgait::client {

class McapLog {
 public:
  explicit McapLog(const std::string& library);

  // A topic whose messages are JSON objects that `schema` (a JSON schema) describes. Returns the channel.
  uint16_t AddChannel(const std::string& topic, const std::string& schema_name, const nlohmann::json& schema);

  // Contract: the channel was added; times do not decrease.
  void AddMessage(uint16_t channel, double time_s, const nlohmann::json& message);

  // The whole file.
  std::string Finish() const;

 private:
  std::string bytes_, definitions_;
  std::map<uint16_t, uint64_t> counts_;  // messages of each channel
  uint64_t first_ns_ = 0, last_ns_ = 0;
};

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_MCAP_LOG_H_
