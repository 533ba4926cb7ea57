#ifndef ROLLGAIT_BENCH_SERVICE_LOAD_LATENCIES_H_
#define ROLLGAIT_BENCH_SERVICE_LOAD_LATENCIES_H_

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cstdint>

namespace rollgait::load {

// How often each latency occurred, in buckets whose width is at most 1/64 of their value (as HdrHistogram does), so
// that percentiles of any number of samples take constant memory. Negative values count as zero. One thread at a time.
class Latencies {
 public:
  void Add(std::chrono::nanoseconds latency) {
    const int64_t value = std::max<int64_t>(0, latency.count());
    ++counts_[Bucket(static_cast<uint64_t>(value))];
    ++count_;
    largest_ = std::max(largest_, value);
  }

  void Add(const Latencies& other) {
    for (size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
    count_ += other.count_;
    largest_ = std::max(largest_, other.largest_);
  }

  int64_t count() const { return count_; }
  double largest_ms() const { return static_cast<double>(largest_) * 1e-6; }

  // The smallest latency in ms that at least `percent` % of the samples do not exceed, rounded up by at most 1/64; 0
  // without samples.
  double PercentileMs(double percent) const {
    const auto wanted = static_cast<int64_t>(static_cast<double>(count_) * percent / 100 + 0.999999);
    int64_t seen = 0;
    for (size_t i = 0; i < counts_.size(); ++i) {
      seen += counts_[i];
      if (seen >= wanted && seen > 0) {
        return static_cast<double>(std::min(largest_, static_cast<int64_t>(UpperEnd(i)))) * 1e-6;
      }
    }
    return 0;
  }

 private:
  static constexpr int kBits = 6;  // of the value that a bucket keeps, below the leading one
  static constexpr size_t kPerOctave = size_t{1} << kBits;

  static size_t Bucket(uint64_t value) {
    const int shift = std::max(0, static_cast<int>(std::bit_width(value)) - 1 - kBits);
    return static_cast<size_t>(shift) * kPerOctave + static_cast<size_t>(value >> shift);
  }
  // The largest value of a bucket.
  static uint64_t UpperEnd(size_t bucket) {
    const size_t shift = bucket < 2 * kPerOctave ? 0 : bucket / kPerOctave - 1;
    return ((static_cast<uint64_t>(bucket - shift * kPerOctave) + 1) << shift) - 1;
  }

  std::array<int64_t, (64 - kBits) * kPerOctave + kPerOctave> counts_{};
  int64_t count_ = 0;
  int64_t largest_ = 0;
};

}  // namespace rollgait::load

#endif  // ROLLGAIT_BENCH_SERVICE_LOAD_LATENCIES_H_
