// Rows of numbers as text that is a quarter of the size of decimals: 16-bit integers in base64, a scale a row.
#ifndef ROLLGAIT_CLIENT_REPORT_PACKED_ROWS_H_
#define ROLLGAIT_CLIENT_REPORT_PACKED_ROWS_H_

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace rollgait::client {

// Each number is scale · integer with |integer| ≤ 32767: the error is at most 1.6e-5 of the row's largest magnitude.
// The integer −32768 stands for a number that is not finite.
class PackedRows {
 public:
  explicit PackedRows(int columns) : columns_(columns) {}

  // Returns the index of the new row. The row must have `columns` values.
  int Add(const std::vector<double>& row);

  // {columns, scales: [one a row], data: base64 of the integers, little endian, row by row}
  nlohmann::json ToJson() const;

 private:
  int columns_;
  std::vector<double> scales_;
  std::string bytes_;
};

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_REPORT_PACKED_ROWS_H_
