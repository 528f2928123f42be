// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/run/child_process.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern "C" {
#include <sys/pidfd.h> // of glibc 2.36, which forgets to say that it is C
}

#include <cerrno>
#include <csignal>
#include <cstring>

#include "plugins/wheelchair/core/record/scenario.hpp"

namespace tandem::wheelchair {

namespace {

using namespace std::chrono_literals;

/// The two posix_spawn objects, freed in any case.
class SpawnSettings {
  public:
    SpawnSettings() {
        posix_spawnattr_init(&attributes_);
        posix_spawn_file_actions_init(&actions_);
    }
    ~SpawnSettings() {
        posix_spawn_file_actions_destroy(&actions_);
        posix_spawnattr_destroy(&attributes_);
    }
    SpawnSettings(const SpawnSettings&) = delete;
    SpawnSettings& operator=(const SpawnSettings&) = delete;

    /// The child starts without our blocked signals, and outside our process group.
    void set_signals_and_group() {
        sigset_t none, all;
        sigemptyset(&none);
        sigfillset(&all);
        posix_spawnattr_setsigmask(&attributes_, &none);
        posix_spawnattr_setsigdefault(&attributes_, &all);
        posix_spawnattr_setpgroup(&attributes_, 0);
        posix_spawnattr_setflags(&attributes_,
                                 POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    }

    void set_io(const ChildIo& io) {
        int target = 0;
        for (int fd : {io.input, io.output, io.errors}) {
            if (fd >= 0) posix_spawn_file_actions_adddup2(&actions_, fd, target);
            ++target;
        }
        if (!io.folder.empty()) posix_spawn_file_actions_addchdir_np(&actions_, io.folder.c_str());
    }

    int spawn(pid_t& pid, const std::vector<std::string>& command) {
        std::vector<char*> arguments;
        for (const auto& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
        arguments.push_back(nullptr);
        return posix_spawnp(&pid, arguments[0], &actions_, &attributes_, arguments.data(), environ);
    }

  private:
    posix_spawnattr_t attributes_;
    posix_spawn_file_actions_t actions_;
};

} // namespace

Fd& Fd::operator=(Fd&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
}

Fd::~Fd() {
    if (fd_ >= 0) close(fd_);
}

std::string ExitStatus::text() const {
    if (!signalled) return fmt::format("exited with {}", code);
    return fmt::format("was killed by signal {} ({})", code, strsignal(code));
}

ChildProcess::ChildProcess(const std::vector<std::string>& command, const ChildIo& io) {
    SpawnSettings settings;
    settings.set_signals_and_group();
    settings.set_io(io);
    const int error = settings.spawn(pid_, command);
    if (error != 0)
        throw InputError(fmt::format("{} cannot be started: {}", command.at(0), std::strerror(error)));
    pidfd_ = Fd(pidfd_open(pid_, 0));
    if (pidfd_.get() >= 0) return;
    const std::string reason = std::strerror(errno);
    stop(0ms);
    throw InputError(fmt::format("{} cannot be watched: {}", command.at(0), reason));
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)), pidfd_(std::move(other.pidfd_)), ended_(std::move(other.ended_)) {}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
    std::swap(pid_, other.pid_);
    std::swap(pidfd_, other.pidfd_);
    std::swap(ended_, other.ended_);
    return *this;
}

ChildProcess::~ChildProcess() {
    if (pid_ > 0 && !poll()) stop(0ms);
}

// A pid stays ours until it is reaped, so the signal cannot hit anybody else.
void ChildProcess::signal(int number) {
    if (pid_ > 0 && !ended_) kill(pid_, number);
}

const std::optional<ExitStatus>& ChildProcess::poll() {
    int status = 0;
    if (!ended_ && waitpid(pid_, &status, WNOHANG) == pid_) {
        if (WIFSIGNALED(status))
            ended_ = ExitStatus{true, WTERMSIG(status)};
        else
            ended_ = ExitStatus{false, WEXITSTATUS(status)};
    }
    return ended_;
}

const std::optional<ExitStatus>& ChildProcess::wait(std::chrono::milliseconds bound) {
    const auto end = std::chrono::steady_clock::now() + bound;
    while (!poll()) {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
        if (left <= 0ms) break;
        // Without a pidfd (no more descriptors) look often instead.
        pollfd event{pidfd_.get(), POLLIN, 0};
        ::poll(&event, 1, static_cast<int>(pidfd_.get() >= 0 ? left.count() + 1 : 5));
    }
    return ended_;
}

const std::optional<ExitStatus>& ChildProcess::stop(std::chrono::milliseconds grace) {
    signal(SIGTERM);
    if (grace > 0ms && wait(grace)) return ended_;
    signal(SIGKILL);
    return wait(5s);
}

} // namespace tandem::wheelchair
