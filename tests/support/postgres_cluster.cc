#include "tests/support/postgres_cluster.h"

#include <fcntl.h>
#include <grp.h>
#include <libpq-fe.h>
#include <poll.h>
#include <pwd.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "core/base/check.h"

namespace rollgait {
namespace {

constexpr char kUser[] = "rollgait";

[[noreturn]] void Die(const std::string& reason) {
  std::fprintf(stderr, "PostgresCluster: %s\n", reason.c_str());
  std::abort();
}

// Where initdb and postgres are: Debian keeps them out of PATH, one folder a version.
std::string Programs() {
  std::vector<std::string> folders;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/usr/lib/postgresql", error)) {
    const std::string folder = entry.path().string() + "/bin";
    if (access((folder + "/initdb").c_str(), X_OK) == 0) folders.push_back(folder);
  }
  if (folders.empty()) Die("there is no /usr/lib/postgresql/*/bin/initdb; run scripts/install-packages");
  return *std::max_element(folders.begin(), folders.end());
}

const passwd& Nobody() {
  const passwd* entry = getpwnam("nobody");
  if (entry == nullptr) Die("there is no user nobody");
  return *entry;
}

// Starts a program as nobody when we are root; output goes to `log`.
pid_t Spawn(const std::vector<std::string>& arguments, const std::string& directory, const std::string& log) {
  const bool root = geteuid() == 0;
  const passwd user = root ? Nobody() : passwd{};
  std::vector<char*> pointers;
  for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
  pointers.push_back(nullptr);
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid != 0) return pid;
  // Only calls that are safe after fork.
  if (root && (setgroups(0, nullptr) != 0 || setgid(user.pw_gid) != 0 || setuid(user.pw_uid) != 0)) _exit(126);
  if (prctl(PR_SET_PDEATHSIG, SIGQUIT) != 0 || getppid() != parent || chdir(directory.c_str()) != 0) _exit(126);
  const int in = open("/dev/null", O_RDONLY), out = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  if (in < 0 || out < 0) _exit(126);
  dup2(in, 0);
  dup2(out, 1);
  dup2(out, 2);
  for (int fd = 3; fd < 256; ++fd) close(fd);
  setsid();
  execv(pointers[0], pointers.data());
  _exit(127);
}

void RunToEnd(const std::vector<std::string>& arguments, const std::string& directory) {
  const std::string log = directory + "/setup.log";
  int status = 0;
  const pid_t pid = Spawn(arguments, directory, log);
  ROLLGAIT_CHECK(waitpid(pid, &status, 0) == pid);
  if (status != 0) Die(arguments[0] + " failed; see " + log);
}

std::string Escaped(const std::string& path) {
  std::string text;
  for (const char letter : path) text += letter == '/' ? "%2F" : std::string(1, letter);
  return text;
}

}  // namespace

PostgresCluster::PostgresCluster(const Options& options) : options_(options) {
  std::string name = "/tmp/rollgait-pg-XXXXXX";
  ROLLGAIT_CHECK(mkdtemp(name.data()) != nullptr);
  directory_ = name;
  if (geteuid() == 0) ROLLGAIT_CHECK(chown(name.c_str(), Nobody().pw_uid, Nobody().pw_gid) == 0);
  const std::string data = directory_ + "/data";
  if (options.primary != nullptr) {
    RunToEnd({Programs() + "/pg_basebackup", "-d", options.primary->Url(), "-D", data, "-R", "-X", "stream", "-c",
              "fast", "--no-sync"},
             directory_);
  } else {
    RunToEnd({Programs() + "/initdb", "-D", data, "-U", kUser, "-A", "trust", "-E", "UTF8", "--locale=C", "--no-sync"},
             directory_);
  }
  Start();
}

PostgresCluster::~PostgresCluster() {
  if (pid_ > 0) {
    kill(pid_, SIGQUIT);
    waitpid(pid_, nullptr, 0);
  }
  std::error_code error;
  std::filesystem::remove_all(directory_, error);
}

void PostgresCluster::Start() {
  std::vector<std::string> arguments = {Programs() + "/postgres", "-D", directory_ + "/data", "-k", directory_, "-c",
                                        "listen_addresses="};
  if (!options_.durable) arguments.insert(arguments.end(), {"-c", "fsync=off"});
  for (const std::string& setting : options_.settings) arguments.insert(arguments.end(), {"-c", setting});
  pid_ = Spawn(arguments, directory_, directory_ + "/server.log");
  for (int tries = 0; tries < 1200; ++tries) {
    if (PQping(Url().c_str()) == PQPING_OK) return;
    if (waitpid(pid_, nullptr, WNOHANG) == pid_) {
      // After a kill its children may hold the shared memory for another moment.
      poll(nullptr, 0, 200);
      pid_ = Spawn(arguments, directory_, directory_ + "/server.log");
    }
    poll(nullptr, 0, 50);
  }
  Die("the server does not start; see " + directory_ + "/server.log");
}

void PostgresCluster::Kill() {
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
  pid_ = 0;
}

void PostgresCluster::Promote() { Execute("SELECT pg_promote(true, 60)"); }

std::string PostgresCluster::Url(const std::string& schema) const {
  const std::string url = std::string("postgresql://") + kUser + "@/postgres?host=" + Escaped(directory_);
  if (schema.empty()) return url;
  Execute("CREATE SCHEMA IF NOT EXISTS " + schema);
  return url + "&options=-csearch_path%3D" + schema;
}

std::string PostgresCluster::Execute(const std::string& sql) const {
  PGconn* connection = PQconnectdb(Url().c_str());
  PQsetNoticeProcessor(
      connection, [](void*, const char*) {}, nullptr);
  PGresult* result = PQexec(connection, sql.c_str());
  const ExecStatusType status = PQresultStatus(result);
  if (status != PGRES_COMMAND_OK && status != PGRES_TUPLES_OK) Die(sql + ": " + PQerrorMessage(connection));
  const std::string value = PQntuples(result) > 0 && PQnfields(result) > 0 ? PQgetvalue(result, 0, 0) : "";
  PQclear(result);
  PQfinish(connection);
  return value;
}

}  // namespace rollgait
