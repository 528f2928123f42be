// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/record/lockstep_recording.hpp"
#include "apps/tandem/run/commands.hpp"
#include "apps/tandem/run/lockstep.hpp"
#include "apps/tandem/run/run_folder.hpp"
#include "host/log/log_output.hpp"
#include "host/log/output_failures.hpp"
#include "host/process/file_descriptor.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>
#include <systemd/sd-daemon.h>
#include <unistd.h>

namespace tandem::command {
namespace {

using namespace std::chrono_literals;

/// Like sd_notify(3), but waits at most `bound` if the service manager does not read, and then drops the message. The
/// hosts need supervision meanwhile.
void notify(const std::string& message, std::chrono::microseconds bound) {
    const char* const path = std::getenv("NOTIFY_SOCKET");
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path == nullptr || *path == 0) return;
    const std::size_t length = std::string(path).copy(address.sun_path, sizeof address.sun_path - 1);
    if (address.sun_path[0] == '@') address.sun_path[0] = 0; // abstract address, see unix(7)
    const process::FileDescriptor socket(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    const timeval limit{0, bound.count()};
    setsockopt(socket.get(), SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
    sendto(socket.get(), message.data(), message.size(), MSG_NOSIGNAL | (bound == 0us ? MSG_DONTWAIT : 0),
           reinterpret_cast<const sockaddr*>(&address),
           static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + length));
}

constexpr auto no_wait = 0us, short_wait = 500'000us;

/// Notifies systemd about a run that is a service of Type=notify (sd_notify(3)). Sends nothing in a
/// terminal. [one thread]
class ServiceManager {
  public:
    ServiceManager() {
        std::uint64_t limit_us = 0;
        if (sd_watchdog_enabled(0, &limit_us) > 0) pause_ = std::chrono::microseconds(limit_us / 4);
    }

    void report_ready() { notify("READY=1", short_wait); }
    void report_stopping() { notify("STOPPING=1", short_wait); }
    void report_status(const std::string& line) {
        std::string text = line;
        std::replace(text.begin(), text.end(), '\n', ' '); // a newline starts another assignment
        notify("STATUS=" + text, no_wait);
    }

    /// Sends a keep-alive. Call this at least twice per WatchdogSec= of the unit. Without WatchdogSec= it
    /// sends nothing.
    void keep_alive() {
        if (pause_.count() == 0) return;
        const auto now = std::chrono::steady_clock::now();
        if (now < next_) return;
        next_ = now + pause_;
        notify("WATCHDOG=1", no_wait);
    }

  private:
    std::chrono::microseconds pause_{0}; ///< between two watchdog messages; 0: none
    std::chrono::steady_clock::time_point next_{};
};

using namespace std::chrono_literals;
using hosts::Host;
using hosts::Supervisor;

/// One run of the hosts, from start to end.
class HostRun {
  public:
    HostRun(const std::vector<hosts::HostCommand>& commands, const RunOptions& options, Lockstep* lockstep,
            LockstepRecording* recording)
        : options_(options), lockstep_(lockstep), recording_(recording) {
        supervisor_.relay_input(STDIN_FILENO);
        for (const auto& command : commands) note_start("started", supervisor_.start(command));
        deadline_ = Clock::now() + seconds(options.wait_s);
    }

    /// Runs until all hosts have ended. Returns the exit code.
    int run() {
        while (!ending_) {
            handle(supervisor_.watch(is_stepping() ? 0ms : 200ms));
            if (!ending_) check_start();
            if (!ending_ && is_stepping()) run_ticks();
        }
        service_.report_stopping();
        const bool in_order = supervisor_.stop_all(
            seconds(options_.grace_s), [this](const Supervisor::Events& events) { on_host_exit(events); });
        if (!in_order && failure_.empty()) failure_ = "a host did not end cleanly; see the lines above";
        const bool has_reader = output_.write("");
        // The last line, because the other hosts may print many lines until they have ended.
        print_note(failure_.empty() ? "all hosts have ended" : "failed: " + failure_);
        notes_.write("");
        if (has_reader && output_.missing() > 0)
            print_note(output_.notice()); // standard error may still be writable
        return failure_.empty() ? 0 : 1;
    }

  private:
    using Clock = std::chrono::steady_clock;
    static std::chrono::milliseconds seconds(double count) {
        return std::chrono::milliseconds(static_cast<long>(1000 * count));
    }
    void print_note(const std::string& line) {
        notes_.write("tandem run: " + replace_control_characters(line) + "\n");
    }
    void note_start(const char* what, const Host& host) {
        print_note(fmt::format("{} {}, pid {}", host.name, what, host.process.pid()));
    }

    void print_lines(const Supervisor::Events& events) {
        std::string lines;
        for (const auto& [host, line] : events.lines)
            if (failure_.empty() || line != host->ready_line) // `ready` would look like a success
                lines += fmt::format("{:<10} | {}\n", host->name, replace_control_characters(line));
        // Ends the run if the reader is gone, as in `tandem run DIR | head`. The robot continues after other write
        // errors.
        if (!output_.write(lines)) ending_ = true;
    }

    void handle(const Supervisor::Events& events) {
        service_.keep_alive();
        print_lines(events);
        if (events.interrupted) {
            print_note("ending the hosts");
            ending_ = true;
        }
        for (Host* host : events.ended) handle_end_of(*host);
        for (Host* host : events.restarted) handle_restart_of(*host);
        for (const auto& [host, reason] : events.failed_restarts)
            print_note(fmt::format("{} cannot be started again yet: {}", host->name, reason));
        if (ending_ || events.became_ready.empty()) return;
        std::string missing;
        for (const Host& host : supervisor_.hosts()) {
            if (!host.ready()) return;
            if (host.ready_line != "ready") missing += fmt::format("; {}: {}", host.name, host.ready_line);
        }
        all_ready_ = true;
        print_note("all hosts are ready" + missing + "; Ctrl-C ends them");
        service_.report_status("all hosts are ready" + missing);
        service_.report_ready();
    }

    // After a request to end, reports only hosts that fail.
    void on_host_exit(const Supervisor::Events& events) {
        service_.keep_alive();
        print_lines(events);
        for (Host* host : events.ended)
            if (!host->process.poll()->success()) print_end(end_of(*host));
    }

    void handle_end_of(Host& host) {
        const std::string end = end_of(host);
        print_end(end);
        // During a run, a host exits successfully only at the request of its components or of a tool.
        if (host.process.poll()->success() || ending_) {
            ending_ = true;
        } else if (host.ready() && restarts_[host.name] < options_.restart) {
            ++restarts_[host.name];
            const auto delay = supervisor_.restart(host);
            if (delay == 0ms) return; // without a wait
            print_note(
                fmt::format("{} ended soon after its start {} times in a row; it is started again in {:g} s",
                            host.name, host.quick_ends, std::chrono::duration<double>(delay).count()));
        } else {
            fail(end + (host.ready() || host.last_line.empty() ? "" : ": " + host.last_line));
        }
    }

    // The first cause counts.
    void fail(const std::string& cause) {
        if (failure_.empty()) failure_ = cause;
        ending_ = true;
    }

    void handle_restart_of(const Host& host) {
        deadline_ = Clock::now() + seconds(options_.wait_s);
        note_start(fmt::format("started again ({} of {})", restarts_[host.name], options_.restart).c_str(),
                   host);
    }

    static std::string end_of(Host& host) {
        return fmt::format("{} (pid {}) {}{}", host.name, host.process.pid(), host.process.poll()->text(),
                           host.ready() ? "" : " before it was ready");
    }

    void print_end(const std::string& line) {
        print_note(line);
        service_.report_status(line);
    }

    bool is_stepping() const { return lockstep_ && all_ready_; }

    // Runs ticks for a time so short that the delay of Ctrl-C is not noticeable.
    void run_ticks() {
        const auto end = Clock::now() + 20ms;
        try {
            if (recording_ && lockstep_->ticks() == 0) begin_recording();
            while (Clock::now() < end && !ending_) {
                lockstep_->run_tick(after_step_);
                if (options_.duration_s > 0 && lockstep_->simulated_s() >= options_.duration_s) {
                    print_note(fmt::format("lock-step finished: {} ticks, {:g} s", lockstep_->ticks(),
                                           lockstep_->simulated_s()));
                    ending_ = true;
                }
            }
        } catch (const std::runtime_error& error) { // an error of the component, or its host has ended
            fail(fmt::format("lock-step, tick {}: {}", lockstep_->ticks() + 1, error.what()));
        }
    }

    void begin_recording() {
        std::vector<pid_t> pids;
        for (const Host& host : supervisor_.hosts()) pids.push_back(host.process.pid());
        recording_->begin(pids, lockstep_->tick());
        after_step_ = [this](std::uint64_t tick, const SteppedComponent& component) {
            recording_->record_step(tick, component.host, component.name);
        };
    }

    void check_start() {
        if (Clock::now() < deadline_) return;
        for (const Host& host : supervisor_.hosts()) {
            if (host.ready() || host.waits_for_restart()) continue;
            const auto line =
                fmt::format("{} (pid {}) was not ready within {:g} s; allow more time with --wait", host.name,
                            host.process.pid(), options_.wait_s);
            print_note(line);
            fail(line);
        }
    }

    const RunOptions options_;
    log::LogOutput output_{STDOUT_FILENO, "tandem run"}, notes_{STDERR_FILENO, "tandem run"};
    ServiceManager service_;
    Supervisor supervisor_;
    Clock::time_point deadline_; ///< for hosts that are not ready yet
    std::map<std::string, int> restarts_;
    Lockstep* const lockstep_;           ///< may be null
    LockstepRecording* const recording_; ///< may be null
    Lockstep::AfterStep after_step_;     ///< set while recording_ is active
    std::string failure_;                ///< its cause; empty: no host has failed
    bool all_ready_ = false, ending_ = false;
};

} // namespace

int run_hosts(const RunOptions& options) {
    log::outlive_output_failures(); // so that failed output does not prevent an orderly end of the hosts
    const RunFolder folder = find_run_folder(options.folder);
    if (folder.application.empty() && !options.node.empty())
        throw std::runtime_error("--node " + options.node + ": " + options.folder.string() +
                                 " has no application in opros/, expected one");
    if (options.lockstep && has_node_connections(folder, options))
        throw std::runtime_error("--lockstep: the application has connections with other nodes, which are in "
                                 "real time; expected an application without <node_map>");
    auto commands = host_commands(folder, options);
    std::optional<Lockstep> lockstep;
    if (options.lockstep) {
        lockstep.emplace(find_stepped_components(folder, options));
        for (auto& command : commands)
            command.command.insert(command.command.end(), {"--lockstep", lockstep->socket(command.name)});
    }
    std::optional<LockstepRecording> recording;
    if (!options.record.empty()) {
        LockstepRecording::prepare_environment();
        recording.emplace(options.record.string());
    }
    const int code =
        HostRun(commands, options, lockstep ? &*lockstep : nullptr, recording ? &*recording : nullptr).run();
    if (!recording) return code;
    recording->close();
    // A reader that has stalled does not delay the end.
    log::LogOutput(STDOUT_FILENO, "tandem run").write(recording->summary() + "\n");
    return code;
}

} // namespace tandem::command
