// SQLite on files in memory does what it does on a disk: locks, snapshots, the log of writes, and files that are gone.
#include "tests/schedules/memory_files.h"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <memory>
#include <string>

namespace rollgait::server {
namespace {

using Connection = std::unique_ptr<sqlite3, int (*)(sqlite3*)>;

Connection Connect(const std::string& path) {
  KeepSqliteFilesInMemory();
  sqlite3* handle = nullptr;
  EXPECT_EQ(sqlite3_open(path.c_str(), &handle), SQLITE_OK);
  return {handle, sqlite3_close};
}

int Do(const Connection& handle, const std::string& sql) {
  return sqlite3_exec(handle.get(), sql.c_str(), nullptr, nullptr, nullptr);
}

// The number that a query answers; -1: none.
int Ask(const Connection& handle, const std::string& sql) {
  int answer = -1;
  const auto keep = [](void* place, int, char** columns, char**) {
    *static_cast<int*>(place) = std::stoi(columns[0]);
    return 0;
  };
  EXPECT_EQ(sqlite3_exec(handle.get(), sql.c_str(), keep, &answer, nullptr), SQLITE_OK);
  return answer;
}

TEST(MemoryFilesTest, OneWriterAtATimeAndReadersKeepTheirSnapshot) {
  const Connection one = Connect("locks.db"), other = Connect("locks.db");
  ASSERT_EQ(Do(one, "PRAGMA journal_mode=WAL; CREATE TABLE t (x); INSERT INTO t VALUES (1)"), SQLITE_OK);
  ASSERT_EQ(Do(other, "BEGIN"), SQLITE_OK);
  EXPECT_EQ(Ask(other, "SELECT COUNT(*) FROM t"), 1);
  ASSERT_EQ(Do(one, "BEGIN IMMEDIATE; INSERT INTO t VALUES (2)"), SQLITE_OK);
  const Connection third = Connect("locks.db");
  EXPECT_EQ(Do(third, "BEGIN IMMEDIATE"), SQLITE_BUSY) << "two write";
  EXPECT_EQ(Ask(third, "SELECT COUNT(*) FROM t"), 1) << "what is not committed is seen";
  ASSERT_EQ(Do(one, "COMMIT"), SQLITE_OK);
  EXPECT_EQ(Ask(third, "PRAGMA wal_checkpoint(TRUNCATE)"), 1) << "the log goes while somebody reads it";
  EXPECT_EQ(Ask(other, "SELECT COUNT(*) FROM t"), 1) << "the snapshot changes";
  ASSERT_EQ(Do(other, "COMMIT"), SQLITE_OK);
  EXPECT_EQ(Ask(other, "SELECT COUNT(*) FROM t"), 2);
  EXPECT_EQ(Do(third, "BEGIN IMMEDIATE; ROLLBACK"), SQLITE_OK);
}

TEST(MemoryFilesTest, WithoutALogReadersKeepWritersOut) {
  const Connection one = Connect("journal.db"), other = Connect("journal.db");
  ASSERT_EQ(Do(one, "CREATE TABLE t (x); INSERT INTO t VALUES (1)"), SQLITE_OK);
  ASSERT_EQ(Do(other, "BEGIN"), SQLITE_OK);
  EXPECT_EQ(Ask(other, "SELECT COUNT(*) FROM t"), 1);
  EXPECT_EQ(Do(one, "INSERT INTO t VALUES (2)"), SQLITE_BUSY);
  ASSERT_EQ(Do(other, "COMMIT"), SQLITE_OK);
  EXPECT_EQ(Do(one, "INSERT INTO t VALUES (2)"), SQLITE_OK);
}

TEST(MemoryFilesTest, WhatIsWrittenIsThereWhenItIsOpenedAgain) {
  {
    const Connection handle = Connect("again.db");
    ASSERT_EQ(Do(handle, "PRAGMA journal_mode=WAL; CREATE TABLE t (x)"), SQLITE_OK);
    for (int i = 0; i < 3000; ++i) ASSERT_EQ(Do(handle, "INSERT INTO t VALUES (randomblob(900))"), SQLITE_OK);
    ASSERT_EQ(Do(handle, "DELETE FROM t WHERE rowid % 3 = 0; PRAGMA wal_checkpoint(TRUNCATE); VACUUM"), SQLITE_OK);
  }
  const Connection handle = Connect("again.db");
  EXPECT_EQ(Ask(handle, "SELECT COUNT(*) FROM t"), 2000);
  EXPECT_EQ(Ask(handle, "SELECT COUNT(*) FROM pragma_integrity_check WHERE integrity_check <> 'ok'"), 0);
}

}  // namespace
}  // namespace rollgait::server
