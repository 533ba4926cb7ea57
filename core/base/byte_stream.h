#ifndef ROLLGAIT_CORE_BASE_BYTE_STREAM_H_
#define ROLLGAIT_CORE_BASE_BYTE_STREAM_H_

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/types.h"

namespace rollgait {

// Numbers and vectors one after another, as this machine holds them: for what the same program reads again. Floating
// point numbers keep every bit. Strings and vectors are preceded by their length.
class ByteWriter {
 public:
  void Put(int64_t value) { PutBytes(&value, sizeof value); }
  void Put(double value) { PutBytes(&value, sizeof value); }
  void Put(const VectorX& values) {
    Put(static_cast<int64_t>(values.size()));
    PutBytes(values.data(), sizeof(double) * static_cast<size_t>(values.size()));
  }
  void Put(std::string_view text) {
    Put(static_cast<int64_t>(text.size()));
    PutBytes(text.data(), text.size());
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void PutBytes(const void* data, size_t size) {
    if (size > 0) bytes_.append(static_cast<const char*>(data), size);
  }
  std::string bytes_;
};

// Reads what a ByteWriter has written, in the same order. Bytes that end too early, or a length beyond what is left,
// give zeros and empty vectors, and ok() is false from then on. Allocates no more than the bytes that are there.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  int64_t Int() { return Number<int64_t>(); }
  double Double() { return Number<double>(); }
  VectorX Vector() {
    const std::string_view bytes = Take(Int(), sizeof(double));
    VectorX values(static_cast<Eigen::Index>(bytes.size() / sizeof(double)));
    if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }
  std::string String() { return std::string(Take(Int(), 1)); }

  bool ok() const { return ok_; }
  // Everything has been read, and nothing is left.
  bool AtEnd() const { return ok_ && rest_.empty(); }

 private:
  template <typename T>
  T Number() {
    T value{};
    const std::string_view bytes = Take(1, sizeof value);
    if (!bytes.empty()) std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }
  std::string_view Take(int64_t count, size_t size) {
    if (count < 0 || static_cast<uint64_t>(count) > rest_.size() / size) ok_ = false;
    if (!ok_) return {};
    const std::string_view taken = rest_.substr(0, static_cast<size_t>(count) * size);
    rest_.remove_prefix(taken.size());
    return taken;
  }
  std::string_view rest_;
  bool ok_ = true;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_BASE_BYTE_STREAM_H_
