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

/// Settings of a new child process. Descriptors remain the caller's. With -1, the child inherits this process's
/// descriptor (`report`: the child has none). It inherits no others.
struct ChildOptions {
    int input = -1, output = -1, errors = -1; ///< its standard input, output and error
    std::string folder{};                     ///< its working folder; empty: that of this process
    int report = -1;                          ///< its report_descriptor
    /// Its standard input and controlling terminal, for which it starts in a new session; empty: none.
    std::string terminal{};
};

/// Owns one child process and watches it through a pidfd. Installs no SIGCHLD handler and reaps no other child, so it
/// works in a host whose components have children. Not thread-safe, but not bound to one thread.
class ChildProcess {
  public:
    /// Starts command[0] (looked up on PATH if it has no slash) in a new process group, with no signal blocked or ignored.
    /// A terminal's Ctrl-C reaches only this process, which then ends the child cleanly. Throws a std::system_error that
    /// names the program if it cannot be started.
    explicit ChildProcess(const std::vector<std::string>& command, const ChildOptions& options = {});
    /// Takes over a child that the caller has forked. The child stays in this process's group, and signals go only to the
    /// child itself. On failure, kills the child and throws std::system_error.
    explicit ChildProcess(pid_t forked);
    ~ChildProcess(); ///< kills and reaps it if it still runs
    ChildProcess(ChildProcess&&) noexcept;
    ChildProcess& operator=(ChildProcess&&) noexcept;

    pid_t pid() const { return pid_; }
    int pidfd() const { return pidfd_.get(); } ///< for poll(): readable once the child has ended

    /// Returns how the child ended, or nothing while it runs. Reaps an ended child and kills the rest of its process group.
    const std::optional<ExitStatus>& poll();
    /// Waits at most `timeout` for the end of the child, then behaves as poll().
    const std::optional<ExitStatus>& wait(std::chrono::milliseconds timeout);
    /// Sends SIGTERM to the child, without waiting for its end.
    void terminate();
    /// Sends SIGTERM to the child and, after `grace`, SIGKILL to its whole group.
    const std::optional<ExitStatus>& stop(std::chrono::milliseconds grace);
    /// Sends SIGKILL to the whole group.
    const std::optional<ExitStatus>& kill();
    /// Waits, after the child's end, at most `timeout` until its process group is empty. Returns false if processes remain.
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

/// Starts a program in a new session, so that it outlives this process and its terminal. Returns false if it cannot be
/// started. [any-thread]
bool start_detached(const std::vector<std::string>& command);

} // namespace tandem::process
