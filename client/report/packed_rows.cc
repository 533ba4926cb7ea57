#include "client/report/packed_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "client/base64.h"
#include "client/failure.h"

namespace rollgait::client {
namespace {

constexpr int kLargest = 32767, kNotFinite = -32768;

}  // namespace

int PackedRows::Add(const std::vector<double>& row) {
  if (static_cast<int>(row.size()) != columns_) {
    throw Failure(ExitCode::kInternal, "a row of " + std::to_string(row.size()) + " numbers in a table of " +
                                           std::to_string(columns_) + " columns");
  }
  double largest = 0;
  for (const double value : row) {
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
  // A subnormal scale has lost its digits; such a row is zero.
  const double scale = largest / kLargest > 1e-300 ? largest / kLargest : 1;
  for (const double value : row) {
    const int integer = std::isfinite(value) ? static_cast<int>(std::lround(value / scale)) : kNotFinite;
    const auto bits = static_cast<uint16_t>(static_cast<int16_t>(integer));
    bytes_ += static_cast<char>(bits & 0xff);
    bytes_ += static_cast<char>(bits >> 8);
  }
  scales_.push_back(scale);
  return static_cast<int>(scales_.size()) - 1;
}

nlohmann::json PackedRows::ToJson() const {
  return {{"columns", columns_}, {"scales", scales_}, {"data", Base64(bytes_)}};
}

}  // namespace rollgait::client
