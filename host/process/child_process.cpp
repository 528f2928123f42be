// SPDX-License-Identifier: Apache-2.0
#include "host/process/child_process.hpp"

#include "host/process/start_thread.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <string>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

extern "C" {
#include <sys/pidfd.h> // in glibc 2.36 this header lacks its own extern "C"
}

namespace tandem::process {
namespace {

/// Owns the two objects that tell posix_spawn() how to start a program.
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

    /// The program starts with no signal blocked or ignored, as the leader of a new process group.
    void reset_signals_and_set_group() {
        // A child inherits blocked and ignored signals through exec, and hosts block the signals that end them.
        sigset_t none, all;
        sigemptyset(&none);
        sigfillset(&all);
        posix_spawnattr_setsigmask(&attributes_, &none);
        posix_spawnattr_setsigdefault(&attributes_, &all);
        posix_spawnattr_setpgroup(&attributes_, 0);
        posix_spawnattr_setflags(&attributes_,
                                 POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    }

    /// The program starts as the leader of a new session, which also is a new process group.
    void set_session() {
        short flags = 0;
        posix_spawnattr_getflags(&attributes_, &flags);
        posix_spawnattr_setflags(&attributes_,
                                 static_cast<short>((flags & ~POSIX_SPAWN_SETPGROUP) | POSIX_SPAWN_SETSID));
    }
    /// The leader of a session that opens a terminal gets it as its controlling terminal.
    void set_terminal(const std::string& name) {
        set_session();
        posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, name.c_str(), O_RDWR, 0);
    }
    /// Gives the program descriptor `source` of this process as its descriptor `target`.
    void redirect(int source, int target) { posix_spawn_file_actions_adddup2(&actions_, source, target); }
    /// Closes all descriptors from this one on: libraries open some that a program would inherit.
    void close_from(int first) { posix_spawn_file_actions_addclosefrom_np(&actions_, first); }
    void set_folder(const std::string& folder) {
        posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
    }

    /// Starts command[0], which is looked up on PATH if it has no slash. Returns 0, or the error number.
    int spawn(pid_t& pid, const std::vector<std::string>& command) const {
        std::vector<char*> arguments;
        arguments.reserve(command.size() + 1);
        for (const auto& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
        arguments.push_back(nullptr);
        return posix_spawnp(&pid, arguments[0], &actions_, &attributes_, arguments.data(), environ);
    }

  private:
    posix_spawnattr_t attributes_;
    posix_spawn_file_actions_t actions_;
};

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr int redirected_descriptors = report_descriptor + 1; // plus the three standard streams
constexpr auto kill_timeout = 5s; // only a process stuck inside the kernel survives SIGKILL for that long

[[noreturn]] void fail(int error, const std::string& what) { throw NotStarted(error, what); }

/// Applies the redirections in order. An earlier redirection could overwrite a source below 4, which exists if this
/// process runs with a closed standard stream. Such a source is therefore first duplicated to a higher number.
class Redirections {
  public:
    Redirections(SpawnSettings& settings, const ChildOptions& options) {
        const std::array sources{options.input, options.output, options.errors, options.report};
        for (int target = 0; target < redirected_descriptors; ++target)
            if (sources[target] >= 0) settings.redirect(above_targets(sources[target]), target);
    }

  private:
    int above_targets(int source) {
        if (source >= redirected_descriptors) return source;
        duplicates_.emplace_back(fcntl(source, F_DUPFD_CLOEXEC, redirected_descriptors));
        if (!duplicates_.back()) fail(errno, "the descriptors of a child process");
        return duplicates_.back().get();
    }
    std::vector<FileDescriptor> duplicates_;
};

} // namespace

std::string ExitStatus::text() const {
    if (signalled) return "was killed by signal " + std::to_string(code) + " (" + strsignal(code) + ")";
    if (code < 0) return "has ended with an unknown exit code: other code of this process has reaped it";
    return "exited with " + std::to_string(code);
}

ChildProcess::ChildProcess(const std::vector<std::string>& command, const ChildOptions& options) {
    SpawnSettings settings;
    settings.reset_signals_and_set_group();
    const Redirections redirections(settings, options);
    if (!options.terminal.empty()) settings.set_terminal(options.terminal);
    if (!options.folder.empty()) settings.set_folder(options.folder);
    settings.close_from(options.report < 0 ? report_descriptor : redirected_descriptors);
    if (const int error = settings.spawn(pid_, command); error != 0) {
        pid_ = -1;
        fail(error, command.at(0) + " cannot be started");
    }
    group_ = pid_;
    open_pidfd(command[0]);
}

ChildProcess::ChildProcess(pid_t forked) : pid_(forked) { open_pidfd("a forked process"); }

void ChildProcess::open_pidfd(const std::string& name) {
    pidfd_ = FileDescriptor(pidfd_open(pid_, 0));
    if (pidfd_) return;
    const int error = errno;
    // Without a pidfd no bounded wait is possible; after SIGKILL none is needed.
    ::kill(pid_, SIGKILL);
    kill_group();
    while (waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) continue;
    fail(error, name + " cannot be watched (pidfd_open)");
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)), group_(std::exchange(other.group_, -1)),
      pidfd_(std::move(other.pidfd_)), ended_(other.ended_) {}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
    std::swap(pid_, other.pid_);
    std::swap(group_, other.group_);
    std::swap(pidfd_, other.pidfd_);
    std::swap(ended_, other.ended_);
    return *this;
}

ChildProcess::~ChildProcess() {
    if (pid_ > 0) kill();
}

// Signals through the pidfd, not by process id: if other code has reaped the child, an unrelated process may already
// have its id.
void ChildProcess::signal(int number) {
    if (pid_ > 0 && !ended_) pidfd_send_signal(pidfd_.get(), number, nullptr, 0);
}

void ChildProcess::kill_group() const {
    if (group_ > 0) ::kill(-group_, SIGKILL);
}

const std::optional<ExitStatus>& ChildProcess::poll() {
    if (ended_ || pid_ <= 0) return ended_;
    siginfo_t info{};
    // WNOWAIT leaves the zombie. No other process can get its id until it is reaped, so the group that is killed here
    // is certainly the child's.
    if (waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) != 0) {
        if (errno == ECHILD) ended_ = ExitStatus{false, -1};
        return ended_;
    }
    if (info.si_pid != pid_) return ended_; // still runs
    kill_group();
    int status = 0;
    if (waitpid(pid_, &status, 0) != pid_)
        ended_ = ExitStatus{false, -1};
    else if (WIFSIGNALED(status))
        ended_ = ExitStatus{true, WTERMSIG(status)};
    else
        ended_ = ExitStatus{false, WEXITSTATUS(status)};
    return ended_;
}

const std::optional<ExitStatus>& ChildProcess::wait(std::chrono::milliseconds timeout) {
    const auto deadline = Clock::now() + timeout;
    while (!poll() && pid_ > 0) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
        if (left <= 0ms) break;
        pollfd event{pidfd_.get(), POLLIN, 0};
        ::poll(&event, 1, static_cast<int>(left.count()));
    }
    return ended_;
}

void ChildProcess::terminate() { signal(SIGTERM); }

const std::optional<ExitStatus>& ChildProcess::stop(std::chrono::milliseconds grace) {
    terminate();
    if (wait(grace)) return ended_;
    return kill();
}

const std::optional<ExitStatus>& ChildProcess::kill() {
    if (!poll()) {
        signal(SIGKILL);
        kill_group();
    }
    return wait(kill_timeout);
}

bool ChildProcess::wait_for_group(std::chrono::milliseconds timeout) const {
    // The members of the group are not children of this process, so this process can wait for them only by checking
    // their number.
    const auto deadline = Clock::now() + timeout;
    while (group_ > 0 && ::kill(-group_, 0) == 0) {
        if (Clock::now() >= deadline) return false;
        std::this_thread::sleep_for(1ms);
    }
    return true;
}

bool start_detached(const std::vector<std::string>& command) {
    SpawnSettings settings;
    settings.set_session();
    pid_t pid = 0;
    return settings.spawn(pid, command) == 0;
}

} // namespace tandem::process
