// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/file_descriptor.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace tandem::process {

/// How a child process ended.
struct ExitStatus {
    bool signalled = false;
    int code =
        0; ///< exit code, or the signal's number; -1 if other code of this process has reaped the child

    bool success() const { return !signalled && code == 0; }
    std::string text() const; ///< "exited with 1", "was killed by signal 9 (Killed)"
};

/// The descriptor to which ChildOptions::report connects.
constexpr int report_descriptor = 3;

/// What a child process is started with. Descriptors stay the caller's; -1: the child inherits that of this
/// process (`report`: the child has none).
struct ChildOptions {
    int input = -1, output = -1, errors = -1; ///< its standard input, output and error
    std::string folder{};                     ///< its working folder; empty: that of this process
    int report = -1;                          ///< its report_descriptor
};

/// Owns one child process. It is watched through a pidfd: no SIGCHLD handler is installed and no other child
/// of this process is reaped, so it works inside a host whose components have children of their own.
/// Not thread-safe; any one thread may use it.
class ChildProcess {
  public:
    /// Starts command[0] (looked up on PATH if it has no slash) with no signal blocked or ignored, in a
    /// process group of its own: a terminal's Ctrl-C reaches only this process, which then ends the child in
    /// order. Throws std::system_error that names the program when it cannot be started.
    explicit ChildProcess(const std::vector<std::string>& command, const ChildOptions& options = {});
    /// Takes over a child that the caller has forked; it stays in this process's group, and only the child
    /// itself is ever signalled. Throws std::system_error, after having killed it.
    explicit ChildProcess(pid_t forked);
    ~ChildProcess(); ///< kills and reaps it if it still runs
    ChildProcess(ChildProcess&&) noexcept;
    ChildProcess& operator=(ChildProcess&&) noexcept;

    pid_t pid() const { return pid_; }
    int pidfd() const { return pidfd_.get(); } ///< for poll(): readable once the child has ended

    /// How it ended, if it has; reaps it then, and kills what is left of its process group.
    const std::optional<ExitStatus>& poll();
    /// Waits for its end, at most `timeout`; then as poll().
    const std::optional<ExitStatus>& wait(std::chrono::milliseconds timeout);
    /// SIGTERM to the child, without waiting for its end.
    void terminate();
    /// SIGTERM to the child, and after `grace` SIGKILL to its whole group.
    const std::optional<ExitStatus>& stop(std::chrono::milliseconds grace);
    /// SIGKILL to the whole group.
    const std::optional<ExitStatus>& kill();
    /// After the child's end: waits, at most `timeout`, until no process of its group is left. False: some
    /// are.
    bool wait_for_group(std::chrono::milliseconds timeout) const;

  private:
    void open_pidfd(const std::string& name);
    void signal(int number);
    void kill_group() const;

    pid_t pid_ = -1;
    pid_t group_ = -1; // -1: the group is not the child's own
    FileDescriptor pidfd_;
    std::optional<ExitStatus> ended_;
};

/// Starts a program in a session of its own, which outlives this process and its terminal, and forgets it.
/// False: it cannot be started. [any-thread]
bool start_detached(const std::vector<std::string>& command);

} // namespace tandem::process
