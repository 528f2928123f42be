// SPDX-License-Identifier: Apache-2.0
#include "host/plugin/bounded_child.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

extern "C" {
#include <sys/pidfd.h> // of glibc 2.36, which forgets to say that it is C
}

namespace tandem::plugin {
namespace {

constexpr std::size_t report_limit = 16u << 20, errors_limit = 4096;

void check(int error, const std::string& what) {
    if (error != 0) throw std::system_error(error, std::generic_category(), what);
}

/// Both ends of a pipe; neither is inherited by processes that other threads start meanwhile.
class Pipe {
  public:
    Pipe() {
        check(pipe2(ends_.data(), O_CLOEXEC) == 0 ? 0 : errno, "pipe");
        fcntl(ends_[0], F_SETFL,
              O_NONBLOCK); // after the child's end, a grandchild may still hold the other end
        // Above the numbers that the child gives its own meaning: dup2() onto itself would leave it to be
        // closed.
        const int high = fcntl(ends_[1], F_DUPFD_CLOEXEC, report_descriptor + 1);
        const int error = errno;
        close_writer();
        ends_[1] = high;
        if (high < 0) close(ends_[0]);
        check(high < 0 ? error : 0, "pipe");
    }
    ~Pipe() {
        close(ends_[0]);
        close_writer();
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    int reader() const { return ends_[0]; }
    int writer() const { return ends_[1]; }
    void close_writer() {
        if (ends_[1] >= 0) close(ends_[1]);
        ends_[1] = -1;
    }
    /// What is there now; false once no more can come.
    bool drain(std::string& text) const {
        std::array<char, 4096> chunk;
        for (int i = 0; i < 4096; ++i) {
            const ssize_t got = read(ends_[0], chunk.data(), chunk.size());
            if (got <= 0) return got < 0 && (errno == EAGAIN || errno == EINTR);
            text.append(chunk.data(), static_cast<std::size_t>(got));
        }
        return true;
    }

  private:
    std::array<int, 2> ends_{-1, -1};
};

class SpawnSettings {
  public:
    SpawnSettings() {
        posix_spawnattr_init(&attributes);
        posix_spawn_file_actions_init(&actions);
        // The child starts without our blocked signals, and in a group of its own, so that all of it can be
        // ended.
        sigset_t none, all;
        sigemptyset(&none);
        sigfillset(&all);
        posix_spawnattr_setsigmask(&attributes, &none);
        posix_spawnattr_setsigdefault(&attributes, &all);
        posix_spawnattr_setpgroup(&attributes, 0);
        posix_spawnattr_setflags(&attributes,
                                 POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    }
    ~SpawnSettings() {
        posix_spawn_file_actions_destroy(&actions);
        posix_spawnattr_destroy(&attributes);
    }
    SpawnSettings(const SpawnSettings&) = delete;
    SpawnSettings& operator=(const SpawnSettings&) = delete;

    posix_spawnattr_t attributes;
    posix_spawn_file_actions_t actions;
};

/// A running child; killed and reaped at the end of the scope if need be.
class Child {
  public:
    Child(const std::vector<std::string>& command, const Pipe& report, const Pipe& errors) {
        SpawnSettings settings;
        posix_spawn_file_actions_addopen(&settings.actions, 0, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&settings.actions, 1, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_adddup2(&settings.actions, errors.writer(), 2);
        posix_spawn_file_actions_adddup2(&settings.actions, report.writer(), report_descriptor);
        std::vector<char*> argv;
        for (const auto& argument : command) argv.push_back(const_cast<char*>(argument.c_str()));
        argv.push_back(nullptr);
        check(posix_spawn(&pid_, argv[0], &settings.actions, &settings.attributes, argv.data(), environ),
              command[0]);
        ended_ = pidfd_open(pid_, 0);
        if (ended_ < 0) {
            const int error = errno;
            kill_and_reap();
            check(error, "pidfd_open");
        }
    }
    ~Child() {
        if (pid_ > 0) kill_and_reap();
        if (ended_ >= 0) close(ended_);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    int ended() const { return ended_; } ///< readable once it has ended
    int reap() {
        int status = 0;
        while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) continue;
        kill(-pid_, SIGKILL); // what it has left behind
        pid_ = -1;
        return status;
    }

  private:
    void kill_and_reap() {
        kill(-pid_, SIGKILL);
        reap();
    }

    pid_t pid_ = -1;
    int ended_ = -1;
};

} // namespace

ChildEnd run_bounded(const std::vector<std::string>& command, std::chrono::milliseconds bound) {
    using Clock = std::chrono::steady_clock;
    const auto deadline = Clock::now() + bound;
    Pipe report, errors;
    Child child(command, report, errors);
    report.close_writer();
    errors.close_writer();
    ChildEnd end;
    bool report_open = true, errors_open = true;
    for (;;) {
        std::array<pollfd, 3> fds{{{child.ended(), POLLIN, 0},
                                   {report_open ? report.reader() : -1, POLLIN, 0},
                                   {errors_open ? errors.reader() : -1, POLLIN, 0}}};
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
        const int ready = left > 0 ? poll(fds.data(), fds.size(), static_cast<int>(left)) : 0;
        if (ready < 0 && errno == EINTR) continue;
        if (fds[1].revents) report_open = report.drain(end.report);
        if (fds[2].revents) errors_open = errors.drain(end.errors);
        if (end.errors.size() > errors_limit) end.errors.erase(0, end.errors.size() - errors_limit);
        if (ready <= 0 || end.report.size() > report_limit) { // the child goes with its scope
            end.timed_out = true;
            break;
        }
        if (fds[0].revents) {
            report.drain(end.report);
            errors.drain(end.errors);
            end.status = child.reap();
            break;
        }
    }
    return end;
}

} // namespace tandem::plugin
