#include "server/backup_main.h"

#include <sys/stat.h>

#include <CLI/CLI.hpp>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "server/command_error.h"
#include "server/store/sqlite_backup.h"
#include "server/store/store_location.h"

namespace rollgait::server {
namespace {

constexpr char kPostgres[] =
    "the solves are in PostgreSQL: its own tools copy it while it serves, `pg_dump -Fc` and `pg_restore`";

int Finish(const Outcome<StoreCopy>& copy, const std::string& path) {
  if (!copy.ok()) return ReportError(copy.error());
  std::printf("%s  %" PRId64 " solves, %" PRId64 " results, %.1f MiB, schema version %d\n", path.c_str(),
              copy.value().solves, copy.value().results, static_cast<double>(copy.value().bytes) / (1 << 20),
              copy.value().schema_version);
  return 0;
}

}  // namespace

std::optional<int> RunBackupCommand(int argc, char** argv) {
  const std::string_view first = argc > 1 ? argv[1] : "";
  if (first != "backup" && first != "restore") return std::nullopt;
  std::string data_dir, file;
  CLI::App app("Copies of the SQLite store of a rollgaitd; docs/explanation/stores.md", "rollgaitd");
  app.require_subcommand(1);
  const auto add = [&](const char* name, const char* help, const char* flag, const char* flag_help) {
    CLI::App* const command = app.add_subcommand(name, help);
    command->add_option("--data-dir", data_dir, "Directory of the store, as of rollgaitd")->required();
    command->add_option(flag, file, flag_help)->required();
  };
  add("backup", "Copy the store into a file, also while it serves", "--to", "The file; it must not exist");
  add("restore", "Make a copy the store of a directory that has none", "--from", "The file that `backup` wrote");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  umask(0077);  // a copy holds what the store holds: requests, and the hashes of tokens
  if (std::getenv(kStoreVariable) != nullptr) {
    std::fprintf(stderr, "rollgaitd: %s is set: %s\n", kStoreVariable, kPostgres);
    return 2;
  }
  if (first == "backup") return Finish(BackUpStore({data_dir}, file), file);
  const Outcome<StoreCopy> restored = RestoreStore(file, {data_dir});
  if (restored.ok()) {
    std::fprintf(stderr,
                 "rollgaitd: tokens that were revoked after the copy was made are good again; look at "
                 "`rollgaitd token list`\n");
  }
  return Finish(restored, DataDir{data_dir}.Database());
}

}  // namespace rollgait::server
