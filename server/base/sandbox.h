#ifndef ROLLGAIT_SERVER_BASE_SANDBOX_H_
#define ROLLGAIT_SERVER_BASE_SANDBOX_H_

#include <optional>
#include <string>

namespace rollgait::server {

// Takes from this process, for good, what computing does not need. What is left: memory (none of it executable),
// reading and writing descriptors it holds, clocks, its own signals, lowering its limit of CPU time, its end. Opening,
// connecting and making descriptors answers EPERM; starting programs or threads of other processes' concern (exec,
// ptrace, mount, bpf, kexec ...) ends the process with SIGSYS. Builds with sanitizers keep what the leak checker needs
// besides: opening files to read, one helper process, ptrace. Needs ConfineProcess before. Returns the reason if the
// kernel or its configuration refuses; then nothing has changed.
std::optional<std::string> EnterSandbox();

// Why EnterSandbox would fail on this machine; nothing: it would not. Changes nothing.
std::optional<std::string> SandboxObstacle();

// What --unconfined-solver means, for the help of every program that has it.
inline constexpr char kUnconfinedHelp[] =
    "Let solvers and simulations run without their system call filter, where the kernel offers none";

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_SANDBOX_H_
