#include "tests/schedules/laboratory.h"

#include <filesystem>
#include <utility>

#include "core/base/check.h"

namespace rollgait::server {
namespace {

// More than there are actors: nobody waits for a connection.
constexpr int kConnections = 16;

void Empty(const std::string& directory) {
  for (const auto& entry : std::filesystem::directory_iterator(directory)) std::filesystem::remove(entry.path());
}

}  // namespace

Laboratory::Laboratory(std::unique_ptr<StoreBed> bed) : bed_(std::move(bed)) {
  const std::filesystem::path shared = "/dev/shm";
  const bool in_memory = std::filesystem::is_directory(shared);
  directory_ = ((in_memory ? shared : std::filesystem::temp_directory_path()) / "rollgait-agents-XXXXXX").string();
  ROLLGAIT_CHECK(mkdtemp(directory_.data()) != nullptr);
  remove_directory_ = std::shared_ptr<void>(nullptr, [directory = directory_](void*) {
    std::error_code error;
    std::filesystem::remove_all(directory, error);
  });
  for (size_t agent = 0; agent < kAgents; ++agent) {
    for (const char* part : {"/agents", "/spool", "/iterates"}) {
      std::filesystem::create_directories(WorkDir(agent) + part);
    }
  }
  for (auto& place : places_) {
    place = std::make_unique<Place>();
    Database::Options options;
    options.name = "the store under test";
    options.writers = options.readers = kConnections;
    options.connect = [this, &site = place->site] { return Connect(site); };
    auto store = SqlStore::Open(std::make_unique<Database>(std::move(options)), clock_);
    ROLLGAIT_CHECK(store.ok());
    place->store = std::move(store).value();
  }
}

std::unique_ptr<SqlConnection> Laboratory::Connect(Site& site) {
  std::unique_ptr<SqlConnection> inner;
  if (spare_.empty()) {
    inner = bed_->Connect(clock_);
  } else {
    inner = std::move(spare_.back());
    spare_.pop_back();
  }
  return std::make_unique<FaultyConnection>(site, std::move(inner), [this](std::unique_ptr<SqlConnection> spare) {
    if (!spare->lost()) spare_.push_back(std::move(spare));
  });
}

void Laboratory::Prepare(Scheduler& scheduler) {
  bed_->Clear();
  for (size_t agent = 0; agent < kAgents; ++agent) {
    for (const char* part : {"/agents", "/spool", "/iterates"}) Empty(WorkDir(agent) + part);
  }
  clock_ = VirtualClock();
  clock_.scheduler = &scheduler;
  lock_ = WriterLock();
}

}  // namespace rollgait::server
