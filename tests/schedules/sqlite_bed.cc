#include <sqlite3.h>

#include <filesystem>
#include <string>

#include "core/base/check.h"
#include "server/store/sqlite_connection.h"
#include "tests/schedules/event_words.h"
#include "tests/schedules/memory_files.h"
#include "tests/schedules/store_bed.h"

namespace rollgait::server {
namespace {

constexpr char kEvents[] = "SELECT sequence, payload FROM events WHERE solve = ? AND sequence > ? ORDER BY sequence";

class SqliteBed : public StoreBed, public StoreView {
 public:
  SqliteBed() {
    KeepSqliteFilesInMemory();
    const std::filesystem::path shared = "/dev/shm";
    const bool in_memory = std::filesystem::is_directory(shared);
    std::string name = ((in_memory ? shared : std::filesystem::temp_directory_path()) / "rollgait-XXXXXX").string();
    ROLLGAIT_CHECK(mkdtemp(name.data()) != nullptr);
    directory_ = name;
    // Rows are short, and pages are what a commit writes.
    ROLLGAIT_CHECK(sqlite3_open(path().c_str(), &handle_) == SQLITE_OK);
    Execute("PRAGMA page_size=1024; PRAGMA journal_mode=WAL;");
  }
  ~SqliteBed() override {
    for (sqlite3_stmt* statement : {solves_, events_}) sqlite3_finalize(statement);
    sqlite3_close(handle_);
    std::error_code error;
    std::filesystem::remove_all(directory_, error);
  }

  std::unique_ptr<SqlConnection> Connect(const Clock& clock) override {
    return std::make_unique<SqliteConnection>(path(), clock);
  }
  StoreView& view() override { return *this; }
  bool one_writer() const override { return true; }
  void SetTime(int64_t) override {}

  void Clear() override {
    Open();
    Execute(
        "BEGIN IMMEDIATE; DELETE FROM events; DELETE FROM labels; DELETE FROM places; DELETE FROM warm_starts; "
        "DELETE FROM solves; DELETE FROM results; DELETE FROM audit; DELETE FROM sqlite_sequence; COMMIT;");
    Execute(kSetTenants);
  }

  std::vector<SeenSolve> Solves() override {
    std::vector<SeenSolve> solves;
    while (Step(solves_)) {
      SeenSolve seen;
      seen.number = Int(solves_, 0);
      seen.id = Text(solves_, 1);
      seen.key = Text(solves_, 2);
      seen.owner = Text(solves_, 3);
      seen.tag = Text(solves_, 4);
      seen.state = static_cast<int>(Int(solves_, 5));
      seen.epoch = Int(solves_, 6);
      seen.last_sequence = Int(solves_, 7);
      seen.trimmed = Int(solves_, 8);
      seen.held_events = Int(solves_, 9);
      seen.cancel_requested = Int(solves_, 10) != 0;
      seen.result = Text(solves_, 11);
      seen.error = Text(solves_, 12);
      seen.tenant = Text(solves_, 13);
      seen.priority = static_cast<int>(Int(solves_, 14));
      solves.push_back(std::move(seen));
    }
    return solves;
  }

  std::vector<SeenEvent> Events(int64_t number, int64_t after_sequence) override {
    sqlite3_bind_int64(events_, 1, number);
    sqlite3_bind_int64(events_, 2, after_sequence);
    std::vector<SeenEvent> events;
    while (Step(events_)) events.push_back({Int(events_, 0), WordsOf(Text(events_, 1))});
    return events;
  }

 private:
  std::string path() const { return directory_ + "/store.db"; }

  // The tables are there by now.
  void Open() {
    if (solves_ != nullptr) return;
    ROLLGAIT_CHECK(sqlite3_prepare_v2(handle_, kSelectSolves, -1, &solves_, nullptr) == SQLITE_OK);
    ROLLGAIT_CHECK(sqlite3_prepare_v2(handle_, kEvents, -1, &events_, nullptr) == SQLITE_OK);
    Execute("PRAGMA foreign_keys=ON;");
  }
  void Execute(const char* sql) { ROLLGAIT_CHECK(sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr) == SQLITE_OK); }
  // Resets at the end.
  static bool Step(sqlite3_stmt* statement) {
    const int code = sqlite3_step(statement);
    if (code == SQLITE_ROW) return true;
    ROLLGAIT_CHECK(code == SQLITE_DONE);
    sqlite3_reset(statement);
    return false;
  }
  static int64_t Int(sqlite3_stmt* statement, int column) { return sqlite3_column_int64(statement, column); }
  static std::string Text(sqlite3_stmt* statement, int column) {
    const void* bytes = sqlite3_column_blob(statement, column);
    const auto size = static_cast<size_t>(sqlite3_column_bytes(statement, column));
    return bytes == nullptr ? std::string() : std::string(static_cast<const char*>(bytes), size);
  }

  std::string directory_;
  sqlite3* handle_ = nullptr;
  sqlite3_stmt* solves_ = nullptr;
  sqlite3_stmt* events_ = nullptr;
};

}  // namespace

std::unique_ptr<StoreBed> MakeSqliteBed() { return std::make_unique<SqliteBed>(); }

}  // namespace rollgait::server
