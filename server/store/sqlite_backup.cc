#include "server/store/sqlite_backup.h"

#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "server/base/file_lock.h"
#include "server/store/schema.h"

namespace rollgait::server {
namespace {

namespace fs = std::filesystem;

struct CloseHandle {
  void operator()(sqlite3* handle) const { sqlite3_close(handle); }
};
using Handle = std::unique_ptr<sqlite3, CloseHandle>;

Error Refused(ErrorCode code, const std::string& what) { return {code, what}; }

Error OfSqlite(sqlite3* handle, const std::string& what) {
  const int code = sqlite3_errcode(handle) & 0xff;
  const ErrorCode kind = code == SQLITE_FULL                               ? ErrorCode::kResourceExhausted
                         : code == SQLITE_CORRUPT || code == SQLITE_NOTADB ? ErrorCode::kFailedPrecondition
                                                                           : ErrorCode::kUnavailable;
  return {kind, what + ": " + sqlite3_errmsg(handle)};
}

Outcome<Handle> Open(const std::string& path, int flags) {
  sqlite3* handle = nullptr;
  const int code = sqlite3_open_v2(path.c_str(), &handle, flags | SQLITE_OPEN_EXRESCODE, nullptr);
  Handle owned(handle);
  if (code != SQLITE_OK) {
    return Refused(ErrorCode::kUnavailable, "cannot open " + path + ": " + sqlite3_errstr(code));
  }
  sqlite3_busy_timeout(handle, 5000);
  return owned;
}

// The first column of the first row as a text; "" if there is no row.
Outcome<std::string> Ask(sqlite3* handle, const std::string& path, const char* sql) {
  sqlite3_stmt* statement = nullptr;
  std::string text;
  int code = sqlite3_prepare_v2(handle, sql, -1, &statement, nullptr);
  if (code == SQLITE_OK) code = sqlite3_step(statement);
  if (code == SQLITE_ROW && sqlite3_column_text(statement, 0) != nullptr) {
    text = reinterpret_cast<const char*>(sqlite3_column_text(statement, 0));
  }
  sqlite3_finalize(statement);
  if (code != SQLITE_ROW && code != SQLITE_DONE) return OfSqlite(handle, path);
  return text;
}

// As a URI, in which other bytes than these have a meaning.
std::string Uri(const std::string& path) {
  constexpr char kHex[] = "0123456789ABCDEF";
  std::string uri = "file:";
  for (const unsigned char c : path) {
    if (std::isalnum(c) != 0 || std::strchr("/._-", c) != nullptr) {
      uri += static_cast<char>(c);
    } else {
      uri += {'%', kHex[c >> 4], kHex[c & 15]};
    }
  }
  return uri + "?immutable=1";
}

// Reads every page of a copy that nobody writes to.
Outcome<StoreCopy> Inspect(const std::string& path) {
  const Outcome<Handle> opened = Open(Uri(path), SQLITE_OPEN_READONLY | SQLITE_OPEN_URI);
  if (!opened.ok()) return opened.error();
  sqlite3* const handle = opened.value().get();
  const Outcome<std::string> check = Ask(handle, path, "PRAGMA integrity_check(1)");
  if (!check.ok()) return check.error();
  if (check.value() != "ok") {
    return Refused(ErrorCode::kFailedPrecondition, path + " is damaged: " + check.value());
  }
  StoreCopy copy;
  int64_t version = 0;
  const struct {
    const char* sql;
    int64_t* number;
  } kQuestions[] = {{"SELECT version FROM schema_version", &version},
                    {"SELECT COUNT(*) FROM solves", &copy.solves},
                    {"SELECT COUNT(*) FROM results", &copy.results}};
  for (const auto& question : kQuestions) {
    const Outcome<std::string> answer = Ask(handle, path, question.sql);
    if (!answer.ok()) {
      return Refused(ErrorCode::kFailedPrecondition, path + " is no store of Rollgait: " + sqlite3_errmsg(handle));
    }
    *question.number = std::strtoll(answer.value().c_str(), nullptr, 10);
  }
  if (version < 1 || version > kSchemaVersion) {
    return Refused(ErrorCode::kFailedPrecondition,
                   path + " has schema version " + std::to_string(version) + ", this program reads versions 1 to " +
                       std::to_string(kSchemaVersion) + "; use the rollgaitd that wrote it");
  }
  copy.schema_version = static_cast<int>(version);
  std::error_code failure;
  copy.bytes = static_cast<int64_t>(fs::file_size(path, failure));
  return copy;
}

// Brings a file, or the names in a folder, to the disk.
std::optional<Error> Sync(const std::string& path) {
  const int fd = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool synced = fd >= 0 && fsync(fd) == 0;
  const int reason = errno;
  if (fd >= 0) close(fd);
  if (synced) return std::nullopt;
  return Refused(reason == ENOSPC ? ErrorCode::kResourceExhausted : ErrorCode::kUnavailable,
                 "cannot bring " + path + " to the disk: " + std::strerror(reason));
}

std::string FolderOf(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

// Lets `write` make "PATH.partial", checks it, and gives it its name once it is on the disk. An existing PATH stays.
Outcome<StoreCopy> WriteWhole(const std::string& path,
                              const std::function<std::optional<Error>(const std::string& partial)>& write) {
  const std::string partial = path + ".partial";
  std::error_code failure;
  fs::remove(partial, failure);
  std::optional<Error> error = write(partial);
  Outcome<StoreCopy> copy = error ? Outcome<StoreCopy>(*error) : Inspect(partial);
  if (copy.ok()) error = Sync(partial);
  if (copy.ok() && !error && link(partial.c_str(), path.c_str()) != 0) {
    error = Refused(errno == EEXIST ? ErrorCode::kAlreadyExists : ErrorCode::kUnavailable,
                    "cannot write " + path + ": " + std::strerror(errno));
  }
  fs::remove(partial, failure);
  if (copy.ok() && !error) error = Sync(FolderOf(path));
  if (error) return *error;
  return copy;
}

std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

// Nobody may serve or work in a directory whose store is replaced.
Outcome<FileLock> TakeWhole(const DataDir& dir) {
  Outcome<std::optional<FileLock>> server = FileLock::TryAcquire(dir.ServerLock());
  if (!server.ok()) return server.error();
  if (!server.value()) {
    return Refused(ErrorCode::kFailedPrecondition, "a rollgaitd serves " + dir.path + "; stop it first");
  }
  std::error_code failure;
  for (const auto& entry : fs::directory_iterator(dir.AgentsDir(), failure)) {
    if (entry.path().extension() != ".lock") continue;
    const Outcome<std::optional<FileLock>> agent = FileLock::TryAcquire(entry.path().string());
    if (!agent.ok()) return agent.error();
    if (!agent.value()) {
      return Refused(ErrorCode::kFailedPrecondition,
                     "an agent works in " + dir.path + " (" + entry.path().filename().string() + "); stop it first");
    }
  }
  return std::move(*std::move(server).value());
}

}  // namespace

Outcome<StoreCopy> BackUpStore(const DataDir& from, const std::string& to) {
  std::error_code failure;
  if (!fs::exists(from.Database(), failure)) {
    return Refused(ErrorCode::kNotFound, "there is no store in " + from.path);
  }
  if (fs::exists(to, failure)) {
    return Refused(ErrorCode::kAlreadyExists, to + " is there already; a backup never replaces a file");
  }
  return WriteWhole(to, [&](const std::string& partial) -> std::optional<Error> {
    const Outcome<Handle> store = Open(from.Database(), SQLITE_OPEN_READWRITE);
    if (!store.ok()) return store.error();
    const std::string sql = "VACUUM INTO " + Quoted(partial);
    if (sqlite3_exec(store.value().get(), sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK) return std::nullopt;
    return OfSqlite(store.value().get(), "cannot copy " + from.Database() + " to " + partial);
  });
}

Outcome<StoreCopy> RestoreStore(const std::string& from, const DataDir& to) {
  std::error_code failure;
  if (!fs::is_regular_file(from, failure)) return Refused(ErrorCode::kNotFound, "there is no file " + from);
  fs::create_directories(to.path, failure);
  const Outcome<FileLock> whole = TakeWhole(to);
  if (!whole.ok()) return whole.error();
  const std::string store = to.Database();
  if (fs::exists(store, failure)) {
    if (fs::file_size(store, failure) != 0 || failure) {
      return Refused(ErrorCode::kFailedPrecondition,
                     to.path + " has a store; move " + store + " (with -wal and -shm) away, or take another directory");
    }
    fs::remove(store, failure);
  }
  // The log of a store that was lost would be taken for that of this one.
  for (const char* const of_lost : {"-wal", "-shm"}) fs::remove(store + of_lost, failure);
  return WriteWhole(store, [&](const std::string& partial) -> std::optional<Error> {
    if (fs::copy_file(from, partial, failure)) return std::nullopt;
    return Refused(failure == std::errc::no_space_on_device ? ErrorCode::kResourceExhausted : ErrorCode::kUnavailable,
                   "cannot copy " + from + " to " + partial + ": " + failure.message());
  });
}

}  // namespace rollgait::server
