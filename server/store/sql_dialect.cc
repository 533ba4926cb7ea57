#include "server/store/sql_dialect.h"

#include "core/base/check.h"

namespace rollgait::server {
namespace {

const char* WordOf(std::string_view name, const SqlDialect& dialect) {
  if (name == "serial_key") return dialect.serial_key;
  if (name == "blob") return dialect.blob;
  if (name == "clustered") return dialect.clustered;
  if (name == "for_update") return dialect.for_update;
  if (name == "skip_locked") return dialect.skip_locked;
  if (name == "boot_id") return dialect.boot_id;
  if (name == "now_ns") return dialect.now_ns;
  if (name == "next_solve") return dialect.next_solve;
  if (name == "next_result") return dialect.next_result;
  if (name == "given_key") return dialect.given_key;
  if (name == "label_lines") return dialect.label_lines;
  if (name == "along_queue") return dialect.along_queue;
  return nullptr;
}

}  // namespace

std::string Translate(std::string_view sql, const SqlDialect& dialect) {
  std::string text;
  size_t position = 0;
  for (size_t open; (open = sql.find('{', position)) != std::string_view::npos;) {
    const size_t close = sql.find('}', open);
    ROLLGAIT_CHECK(close != std::string_view::npos);
    const char* word = WordOf(sql.substr(open + 1, close - open - 1), dialect);
    ROLLGAIT_CHECK(word != nullptr);
    text.append(sql.substr(position, open - position)).append(word);
    position = close + 1;
  }
  return text.append(sql.substr(position));
}

}  // namespace rollgait::server
