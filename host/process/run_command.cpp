// SPDX-License-Identifier: Apache-2.0
#include "host/process/run_command.hpp"

#include "host/process/output_pipe.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/signalfd.h>
#include <system_error>
#include <unistd.h>

namespace tandem::process {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

FileDescriptor checked(int fd, const char* what) {
    if (fd < 0) throw std::system_error(errno, std::generic_category(), what);
    return FileDescriptor(fd);
}

FileDescriptor null_file(int mode) { return checked(open("/dev/null", mode | O_CLOEXEC), "/dev/null"); }

/// Returns a file in memory, not a pipe: the command may read it at any time, or not at all.
FileDescriptor input_file(const std::string& content) {
    if (content.empty()) return null_file(O_RDONLY);
    constexpr const char* name = "input of a command";
    FileDescriptor file = checked(memfd_create(name, MFD_CLOEXEC), name);
    for (std::size_t done = 0; done < content.size();) {
        const ssize_t count = write(file.get(), content.data() + done, content.size() - done);
        if (count <= 0) throw std::system_error(errno, std::generic_category(), name);
        done += static_cast<std::size_t>(count);
    }
    lseek(file.get(), 0, SEEK_SET);
    return file;
}

/// Blocks the signals that end a program in this thread, so that a signalfd can read them instead.
class BlockedSignals {
  public:
    explicit BlockedSignals(bool active) : active_(active) {
        if (!active_) return;
        sigset_t signals;
        sigemptyset(&signals);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
        reader_ = checked(signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK), "signalfd");
        pthread_sigmask(SIG_BLOCK, &signals, &before_);
    }
    ~BlockedSignals() {
        if (active_) pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    BlockedSignals(const BlockedSignals&) = delete;
    BlockedSignals& operator=(const BlockedSignals&) = delete;

    int reader() const { return reader_.get(); } ///< -1 (which poll() skips) unless signals are blocked
    int take() const {
        signalfd_siginfo info{};
        return read(reader_.get(), &info, sizeof info) == sizeof info ? static_cast<int>(info.ssi_signo) : 0;
    }

  private:
    bool active_;
    sigset_t before_{};
    FileDescriptor reader_;
};

/// One stream of the command and the text that the command wrote to it.
struct Capture {
    std::string& text;
    OutputPipe pipe{};
    bool open = true;

    void read_available() {
        if (open) open = pipe.read_available(text);
    }
    int readable() const { return open ? pipe.reader() : -1; }
};

/// A running command.
class RunningCommand {
  public:
    RunningCommand(const std::vector<std::string>& command, const CommandOptions& options)
        : options_(options), signals_(options.stop_on_signal), child_(start(command)) {
        for (Capture* capture : captures()) capture->pipe.close_writer();
    }

    CommandResult wait() {
        const auto deadline = Clock::now() + options_.timeout;
        while (!result_.timed_out && result_.stop_signal == 0 && !wait_for_event(deadline)) continue;
        if (child_.poll()) {
            result_.status = *child_.poll();
            for (Capture* capture : captures()) capture->read_available();
            trim_errors();
        } else {
            child_.kill();
        }
        // Such a process may still use files that the caller deletes next.
        child_.wait_for_group(1s);
        return std::move(result_);
    }

  private:
    std::array<Capture*, 3> captures() { return {&output_, &errors_, &report_}; }

    ChildProcess start(const std::vector<std::string>& command) {
        const FileDescriptor input = input_file(options_.input), null = null_file(O_WRONLY);
        return ChildProcess(command,
                            {input.get(), options_.discard_output ? null.get() : output_.pipe.writer(),
                             options_.merge_errors ? output_.pipe.writer() : errors_.pipe.writer(),
                             options_.folder, options_.capture_report ? report_.pipe.writer() : -1});
    }

    /// Returns true once the command has ended.
    bool wait_for_event(Clock::time_point deadline) {
        std::array<pollfd, 5> events{{{child_.pidfd(), POLLIN, 0},
                                      {signals_.reader(), POLLIN, 0},
                                      {output_.readable(), POLLIN, 0},
                                      {errors_.readable(), POLLIN, 0},
                                      {report_.readable(), POLLIN, 0}}};
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
        const int ready = left > 0 ? ::poll(events.data(), events.size(), static_cast<int>(left)) : 0;
        if (ready < 0 && errno == EINTR) return false;
        for (Capture* capture : captures()) capture->read_available();
        trim_errors();
        if (ready <= 0 || result_.output.size() > options_.max_output ||
            result_.report.size() > options_.max_output)
            result_.timed_out = true;
        if (events[1].revents != 0) result_.stop_signal = signals_.take();
        return events[0].revents != 0;
    }

    void trim_errors() {
        if (result_.errors.size() > options_.max_errors)
            result_.errors.erase(0, result_.errors.size() - options_.max_errors);
    }

    const CommandOptions& options_;
    const BlockedSignals signals_;
    CommandResult result_;
    Capture output_{result_.output}, errors_{result_.errors}, report_{result_.report};
    ChildProcess child_;
};

} // namespace

std::string CommandResult::failure() const {
    if (timed_out) return "was killed because it took too long or wrote too much";
    if (stop_signal != 0) return std::string("was ended by a signal: ") + strsignal(stop_signal);
    const auto begin = errors.find_first_not_of(" \n");
    if (begin == errors.npos) return status.text();
    return errors.substr(begin, errors.find('\n', begin) - begin);
}

CommandResult run_command(const std::vector<std::string>& command, const CommandOptions& options) {
    return RunningCommand(command, options).wait();
}

} // namespace tandem::process
