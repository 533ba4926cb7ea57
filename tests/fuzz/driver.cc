// Runs a fuzz target without libFuzzer: every seed as it is, then as many changed ones as asked for. Equal arguments:
// equal inputs. An input that breaks a promise or crashes is written to the file crash-input.
#include <fcntl.h>
#include <google/protobuf/stubs/logging.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "tests/fuzz/fuzz_target.h"

namespace {

constexpr size_t kMaxSize = 1 << 16;

std::mt19937_64 random_bytes;
const uint8_t* current = nullptr;
size_t current_size = 0;

void KeepInput(int signal) {
  const int fd = open("crash-input", O_CREAT | O_TRUNC | O_WRONLY, 0600);
  if (fd >= 0 && write(fd, current, current_size) >= 0) close(fd);
  ::signal(signal, SIG_DFL);
  raise(signal);
}

std::vector<std::string> Seeds(const std::string& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> seeds;
  for (const auto& path : paths) {
    std::ifstream file(path, std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return seeds;
}

void RunOne(const uint8_t* data, size_t size) {
  current = data;
  current_size = size;
  LLVMFuzzerTestOneInput(current, current_size);
}

// An input that changes.
class Input {
 public:
  void Assign(const std::string& seed) {
    size_ = std::min(seed.size(), kMaxSize);
    std::copy_n(seed.begin(), size_, bytes_.begin());
  }
  void Assign(size_t size) { size_ = size; }
  uint8_t* data() { return bytes_.data(); }
  size_t size() const { return size_; }

 private:
  std::vector<uint8_t> bytes_ = std::vector<uint8_t>(kMaxSize);
  size_t size_ = 0;
};

}  // namespace

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max_size) {
  std::vector<uint8_t> bytes(data, data + size);
  const auto place = [&] { return static_cast<std::ptrdiff_t>(random_bytes() % (bytes.size() + 1)); };
  for (int k = 1 + static_cast<int>(random_bytes() % 6); k > 0; --k) {
    const size_t at = static_cast<size_t>(place());
    switch (random_bytes() % 5) {
      case 0:
        if (at < bytes.size()) bytes[at] ^= static_cast<uint8_t>(1u << random_bytes() % 8);
        break;
      case 1:
        if (at < bytes.size()) bytes[at] = static_cast<uint8_t>(random_bytes());
        break;
      case 2:
        bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), static_cast<uint8_t>(random_bytes()));
        break;
      case 3:
        bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                    bytes.begin() + std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(bytes.size()),
                                                             static_cast<std::ptrdiff_t>(at + random_bytes() % 16)));
        break;
      default: {
        const std::vector<uint8_t> piece(
            bytes.begin() + static_cast<std::ptrdiff_t>(at),
            bytes.begin() + std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(bytes.size()),
                                                     static_cast<std::ptrdiff_t>(at + random_bytes() % 64)));
        bytes.insert(bytes.begin() + place(), piece.begin(), piece.end());
      }
    }
  }
  const size_t count = std::min(bytes.size(), max_size);
  std::copy_n(bytes.begin(), count, data);
  return count;
}

int main(int argc, char** argv) {
  CLI::App app("Feeds a fuzz target with seeds and changed seeds.");
  std::string corpus;
  int64_t runs = 10'000;
  unsigned seed = 1;
  double seconds_at_most = std::numeric_limits<double>::infinity();
  app.add_option("CORPUS", corpus, "Folder of seeds")->required()->check(CLI::ExistingDirectory);
  app.add_option("--runs", runs, "Changed inputs")->capture_default_str();
  app.add_option("--seed", seed, "Of the changes")->capture_default_str();
  app.add_option("--seconds", seconds_at_most, "End after so many seconds with fewer of them");
  double most_memory = std::numeric_limits<double>::infinity();
  app.add_option("--most-memory", most_memory, "MiB; a process that took more has broken a promise");
  CLI11_PARSE(app, argc, argv);
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) ::signal(signal, KeepInput);
  google::protobuf::SetLogHandler(nullptr);  // it reports every text that is not UTF-8
  random_bytes.seed(seed);
  std::vector<std::string> seeds = Seeds(corpus);
  if (seeds.empty()) {
    std::fprintf(stderr, "%s holds no seeds\n", corpus.c_str());
    return 2;
  }
  Input input;
  for (std::string& start : seeds) {
    input.Assign(start);
    RunOne(input.data(), input.size());
    if (FuzzSeedToChange == nullptr) continue;
    input.Assign(FuzzSeedToChange(input.data(), input.size(), kMaxSize));
    RunOne(input.data(), input.size());
    start.assign(input.data(), input.data() + input.size());
  }
  const auto begin = std::chrono::steady_clock::now();
  const auto passed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  int64_t done = 0;
  for (; done < runs && (done % 1024 != 0 || passed() < seconds_at_most); ++done) {
    // Changes pile up for a while, so that inputs also come far from the seeds.
    if (done % 8 == 0) input.Assign(seeds[random_bytes() % seeds.size()]);
    input.Assign(LLVMFuzzerCustomMutator(input.data(), input.size(), kMaxSize, static_cast<unsigned>(random_bytes())));
    RunOne(input.data(), input.size());
  }
  const double seconds = passed();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double memory = static_cast<double>(usage.ru_maxrss) / 1024;
  const bool small = memory <= most_memory;
  std::printf("%zu seeds and %lld changed inputs in %.1f s (%.0f/s), %.0f MiB: %s\n", seeds.size(),
              static_cast<long long>(done), seconds, static_cast<double>(done) / seconds, memory,
              small ? "no promise broken" : "too much memory");
  return small ? 0 : 1;
}
