#include "server/base/process_metrics.h"

#include <prometheus/client_metric.h>
#include <prometheus/metric_type.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "server/base/metrics.h"

namespace rollgait::server {
namespace {

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

double WallSeconds() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

double CpuSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return Seconds(usage.ru_utime) + Seconds(usage.ru_stime);
}

double ResidentBytes() {
  std::ifstream file("/proc/self/statm");
  double total_pages = 0, resident_pages = 0;
  file >> total_pages >> resident_pages;
  return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double EntriesOf(const char* directory) {
  std::error_code error;
  const std::filesystem::directory_iterator entries(directory, error);
  return error ? 0 : static_cast<double>(std::distance(entries, {}));
}

double MaxDescriptors() {
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  return static_cast<double>(limit.rlim_cur);
}

}  // namespace

ProcessMetrics::ProcessMetrics() : start_time_s_(WallSeconds()) {}

std::vector<prometheus::MetricFamily> ProcessMetrics::Collect() const {
  prometheus::ClientMetric cpu;
  cpu.counter.value = CpuSeconds();
  return {{"process_cpu_seconds_total", "CPU time, user and system, in s", prometheus::MetricType::Counter, {cpu}},
          GaugeNow("process_resident_memory_bytes", "Memory in use, in bytes", ResidentBytes()),
          GaugeNow("process_open_fds", "Open file descriptors", EntriesOf("/proc/self/fd")),
          GaugeNow("process_max_fds", "Most file descriptors that may be open", MaxDescriptors()),
          GaugeNow("process_threads", "Threads", EntriesOf("/proc/self/task")),
          GaugeNow("process_start_time_seconds", "When the process began, in s since 1970", start_time_s_)};
}

}  // namespace rollgait::server
