#ifndef ROLLGAIT_TESTS_SUPPORT_POSTGRES_CLUSTER_H_
#define ROLLGAIT_TESTS_SUPPORT_POSTGRES_CLUSTER_H_

#include <sys/types.h>

#include <string>
#include <vector>

namespace rollgait {

// A PostgreSQL server of a test's own, in a new directory under /tmp, on a Unix socket only, run by an unprivileged
// user when the test is root. It dies with the test. Aborts with a sentence if PostgreSQL is not installed.
class PostgresCluster {
 public:
  struct Options {
    bool durable = false;                      // fsync; a test that does not pull the plug needs none
    std::vector<std::string> settings = {};    // name=value
    const PostgresCluster* primary = nullptr;  // set: a streaming standby of it
  };
  PostgresCluster() : PostgresCluster(Options{}) {}
  explicit PostgresCluster(const Options& options);
  PostgresCluster(const PostgresCluster&) = delete;
  PostgresCluster& operator=(const PostgresCluster&) = delete;
  ~PostgresCluster();

  // postgresql:// URL of the database. With a schema (letters, digits, _): one of its own, made if need be.
  std::string Url(const std::string& schema = "") const;
  // The directory of its socket, for URLs of several hosts.
  const std::string& directory() const { return directory_; }

  // Starts it again after Kill; waits until it accepts connections.
  void Start();
  // kill -9 of the server.
  void Kill();
  // Makes a standby a primary; waits until it is.
  void Promote();
  // Runs statements; aborts if one fails. The first column of the first row, if there is one.
  std::string Execute(const std::string& sql) const;

 private:
  std::string directory_;
  Options options_;
  pid_t pid_ = 0;
};

}  // namespace rollgait

#endif  // ROLLGAIT_TESTS_SUPPORT_POSTGRES_CLUSTER_H_
