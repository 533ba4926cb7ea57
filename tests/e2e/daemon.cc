#include "tests/e2e/daemon.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "core/base/check.h"

extern char** environ;

namespace rollgait::server {
namespace {

std::string ReadLine(int fd) {
  std::string line;
  char letter = 0;
  while (read(fd, &letter, 1) == 1 && letter != '\n') line += letter;
  return line;
}

// A file of a process; empty if the process is gone, also when it goes between opening and reading (a stream buffer
// would throw then).
std::string ReadOfProcess(pid_t pid, const char* name) {
  const std::string path = "/proc/" + std::to_string(pid) + "/" + name;
  const int fd = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return {};
  std::string text;
  char block[4096];
  for (ssize_t count; (count = read(fd, block, sizeof block)) > 0;) text.append(block, static_cast<size_t>(count));
  close(fd);
  return text;
}

// Arguments of a process, each followed by a zero byte; empty if it is gone.
std::string CommandLine(pid_t pid) { return ReadOfProcess(pid, "cmdline"); }

std::vector<pid_t> AllProcesses() {
  std::vector<pid_t> pids;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") == std::string::npos) pids.push_back(std::stoi(name));
  }
  return pids;
}

// The parent of a living process; 0 if it is gone or a zombie.
pid_t ParentOf(pid_t pid) {
  const std::string text = ReadOfProcess(pid, "stat");
  const size_t end = text.rfind(')');
  if (end == std::string::npos) return 0;
  std::istringstream rest(text.substr(end + 1));
  char state = 'Z';
  pid_t parent = 0;
  rest >> state >> parent;
  return state == 'Z' ? 0 : parent;
}

}  // namespace

Daemon::Daemon(const Options& options) : data_dir_(options.data_dir) {
  int ends[2];
  ROLLGAIT_CHECK(pipe2(ends, O_CLOEXEC) == 0);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  if (!options.log_file.empty()) {
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, options.log_file.c_str(), O_WRONLY | O_CREAT | O_APPEND,
                                     0600);
  }
  std::vector<std::string> arguments = options.launcher;
  arguments.insert(arguments.end(), {ROLLGAITD, "--data-dir", options.data_dir, "--listen", options.listen});
  if (!options.solver.empty()) arguments.insert(arguments.end(), {"--solver", options.solver});
  arguments.insert(arguments.end(), options.flags.begin(), options.flags.end());
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  ROLLGAIT_CHECK(posix_spawnp(&pid_, pointers[0], &actions, nullptr, pointers.data(), environ) == 0);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  output_ = ends[0];
  const std::string line = ReadLine(output_);
  const std::string prefix = "rollgaitd listening on ";
  if (line.rfind(prefix, 0) == 0) address_ = line.substr(prefix.size());
}

Daemon::~Daemon() {
  Kill();
  KillAgents(data_dir_);
  close(output_);
}

void Daemon::Kill() {
  if (pid_ == 0) return;
  kill(pid_, SIGKILL);
  ExitCode();
}

int Daemon::Terminate() {
  kill(pid_, SIGTERM);
  return ExitCode();
}

int Daemon::ExitCode() {
  int status = 0;
  ROLLGAIT_CHECK(waitpid(pid_, &status, 0) == pid_);
  pid_ = 0;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::unique_ptr<v1::GaitService::Stub> Daemon::NewStub() const {
  // A channel of its own: a channel of the same address may still be backing off from the server's last death.
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  return v1::GaitService::NewStub(grpc::CreateCustomChannel(address_, grpc::InsecureChannelCredentials(), arguments));
}

std::string OutputOfRollgaitd(const std::string& arguments) {
  FILE* const pipe = popen((std::string(ROLLGAITD) + " " + arguments + " 2>/dev/null").c_str(), "r");
  ROLLGAIT_CHECK(pipe != nullptr);
  std::string text;
  for (int letter = std::fgetc(pipe); letter != EOF; letter = std::fgetc(pipe)) text += static_cast<char>(letter);
  if (pclose(pipe) != 0) throw std::runtime_error("rollgaitd " + arguments + " failed");
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

std::vector<pid_t> AgentsOf(const std::string& data_dir) {
  std::vector<pid_t> agents;
  for (const pid_t pid : AllProcesses()) {
    const std::string command = CommandLine(pid);
    const bool is_agent = command.substr(0, command.find('\0')).find("rollgait-agent") != std::string::npos;
    if (is_agent && command.find(data_dir + '\0') != std::string::npos && ParentOf(pid) != 0) agents.push_back(pid);
  }
  // A solver has its agent's command line until it becomes the program that it was started for.
  const std::vector<pid_t> found = agents;
  std::erase_if(agents, [&](pid_t pid) { return std::find(found.begin(), found.end(), ParentOf(pid)) != found.end(); });
  return agents;
}

std::vector<pid_t> ChildrenOf(pid_t parent) {
  std::vector<pid_t> children;
  for (const pid_t pid : AllProcesses()) {
    if (ParentOf(pid) == parent) children.push_back(pid);
  }
  return children;
}

void KillAgents(const std::string& data_dir) {
  for (const pid_t agent : AgentsOf(data_dir)) {
    const std::vector<pid_t> solvers = ChildrenOf(agent);
    kill(agent, SIGKILL);
    for (const pid_t solver : solvers) kill(solver, SIGKILL);
  }
}

}  // namespace rollgait::server
