#ifndef ROLLGAIT_SERVER_STORE_SQL_DIALECT_H_
#define ROLLGAIT_SERVER_STORE_SQL_DIALECT_H_

#include <string>
#include <string_view>

namespace rollgait::server {

// The words in braces of our SQL, as an engine says them. All that differs in the text of statements is here:
// sqlite_dialect.cc, postgres_dialect.cc.
struct SqlDialect {
  const char* serial_key;   // {serial_key}: a key that the database counts up
  const char* blob;         // {blob}: the type of bytes
  const char* clustered;    // {clustered}: a table kept in the order of its key
  const char* for_update;   // {for_update}: locks the rows read
  const char* skip_locked;  // {skip_locked}: passes over rows that another transaction has locked
  // The clock that leases expire by: a time in ns that never jumps while the boot id stays the same, in every process.
  const char* boot_id;  // {boot_id}
  const char* now_ns;   // {now_ns}
  // A key that is known before its row is inserted, so that rows which refer to it need not wait for it.
  const char* next_solve;   // {next_solve}: a number for solves
  const char* next_result;  // {next_result}: an id for results
  const char* given_key;    // {given_key}: inserts such a key
  const char* label_lines;  // {label_lines}: JoinLabels of rows of `labels`, in any order
  // {along_queue}: after solves or its alias; what reads queued solves goes along the index solves_queued. Without
  // statistics SQLite takes another, and reads the whole queue.
  const char* along_queue;
};

extern const SqlDialect kSqliteDialect;
extern const SqlDialect kPostgresDialect;

// Replaces the words. A brace that opens none of them is a defect.
std::string Translate(std::string_view sql, const SqlDialect& dialect);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_SQL_DIALECT_H_
