// SPDX-License-Identifier: Apache-2.0
// A process of ours: started, watched through a pidfd, ended in bounded time. Never signals anything but its
// own pid.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tandem::wheelchair {

/// Owns a file descriptor.
class Fd {
  public:
    explicit Fd(int fd = -1) : fd_(fd) {}
    Fd(Fd&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    Fd& operator=(Fd&& other) noexcept;
    ~Fd();
    int get() const { return fd_; }

  private:
    int fd_;
};

struct ExitStatus {
    bool signalled = false;
    int code = 0;             // exit code, or number of the signal
    std::string text() const; // "exited with 1", "was killed by signal 9 (Killed)"
};

struct ChildIo {
    int input = -1, output = -1, errors = -1; // -1: ours
    std::string folder;                       // empty: ours
};

class ChildProcess {
  public:
    /// Starts command[0] (looked up on PATH) in a process group of its own, so that a Ctrl-C reaches it
    /// through us and in order. Throws InputError when it cannot be started.
    ChildProcess(const std::vector<std::string>& command, const ChildIo& io);
    ~ChildProcess(); // kills and reaps it if it still runs
    ChildProcess(ChildProcess&&) noexcept;
    ChildProcess& operator=(ChildProcess&&) noexcept;

    pid_t pid() const { return pid_; }
    int pidfd() const { return pidfd_.get(); } // readable once it has ended
    /// How it ended, if it has.
    const std::optional<ExitStatus>& poll();
    /// Waits for its end at most `bound`.
    const std::optional<ExitStatus>& wait(std::chrono::milliseconds bound);
    /// SIGTERM, and SIGKILL after `grace`.
    const std::optional<ExitStatus>& stop(std::chrono::milliseconds grace);

  private:
    void signal(int number);

    pid_t pid_ = -1;
    Fd pidfd_;
    std::optional<ExitStatus> ended_;
};

} // namespace tandem::wheelchair
