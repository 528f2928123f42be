// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <ios>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/hosts/input_relay.hpp"
#include "host/process/child_process.hpp"
#include "host/process/output_pipe.hpp"

namespace tandem::hosts {

/// The command that starts a host.
struct HostCommand {
    std::string name; ///< for messages: opros_host or rtm_host
    std::vector<std::string> command;
    /// File for standard error. If empty, standard error and standard output arrive as Events::lines.
    std::string log;
    std::string folder{};                         ///< working folder; empty: that of this program
    std::vector<std::string> restart_arguments{}; ///< added when a host that was ready is restarted
};

/// A host process and the data to restart it.
struct Host : HostCommand {
    std::streamoff
        log_start; // offset in the log at which this process began: a restarted host appends to the file
    process::ChildProcess process;
    process::OutputPipe output; // its standard output
    std::string unread{};       // the beginning of an incomplete line of its output
    std::string last_line{};    // of its output
    double unread_since = 0.0;  // CLOCK_MONOTONIC [s] of the newest part of `unread`
    int blank_lines = 0;        // held back until it is ready, because `ready` adds one
    double ready_at = 0.0;      // CLOCK_MONOTONIC [s] at which it wrote the line `ready`; 0: not yet
    std::string ready_line{};   // `ready`, or `ready, but ...` if it lacks components; empty: not ready yet
    bool ended = false;         // watch() has reported its end
    double started_at = 0.0;    // CLOCK_MONOTONIC [s]
    int quick_ends = 0;         // in a row, see Supervisor::restart()
    double restart_at = 0.0;    // CLOCK_MONOTONIC [s] at which watch() restarts it; 0: it does not
    bool was_ready = false;     // before its end

    bool waits_for_restart() const { return restart_at > 0.0; }
    bool ready() const { return ready_at > 0.0; }
    bool running() const { return !ended; }
    std::string command_line() const; // quoted, so that users can type it in a shell
    std::string first_error() const;  // first logged line with "error", or the last line
};

/// Starts, watches and stops hosts. While it exists, it blocks SIGINT, SIGTERM, SIGHUP and SIGQUIT of this
/// program, and watch() reports them, so that the hosts can be stopped cleanly. At SIGTSTP (Ctrl-Z), watch()
/// gives the user's terminal back and stops this program; the hosts continue. [main-thread]
class Supervisor {
  public:
    Supervisor();
    ~Supervisor(); // stops the running hosts in reverse start order

    /// Passes the data of `source` to the standard input of all hosts started from here on. If `source` is a
    /// terminal, each host gets a terminal.
    void relay_input(int source) { input_.emplace(source); }
    /// Starts a host. Appends to an existing log. Throws std::runtime_error if the host cannot be started.
    Host& start(const HostCommand& command);
    /// Has watch() restart a host that has ended, with the same command and log, and with restart_arguments if
    /// it was ready. Returns how long it waits before: 0 after the first end, then 0.1 s, 0.2 s and so on up to
    /// 10 s after each further end within 10 s of its start.
    std::chrono::milliseconds restart(Host& host);

    /// Events since the last call of watch().
    struct Events {
        std::vector<Host*> ended, became_ready;
        std::vector<Host*> restarted;
        std::vector<std::pair<const Host*, std::string>> failed_restarts; // why; watch() tries again
        std::vector<std::pair<const Host*, std::string>> lines;           // of hosts without a log
        bool interrupted = false; // a signal asked this program to end
    };
    /// Waits until something happens, at most `timeout`.
    Events watch(std::chrono::milliseconds timeout);

    /// Waits until all hosts are ready; all must have logs. Throws std::runtime_error with a host's first
    /// error if it ends or is not ready within `seconds`, and Interrupted if a signal asks this program to
    /// end.
    void wait_until_ready(double seconds);

    /// Sends SIGTERM, and SIGKILL if the host has not ended after 5 s. Returns true if it exited with code
    /// 0.
    bool stop(Host& host);

    /// Sends SIGTERM to all hosts. Sends SIGKILL after `grace`, or if a second signal arrives more than a
    /// second later. Calls `handle` for events meanwhile. Returns true if all hosts exited with code 0.
    bool stop_all(std::chrono::milliseconds grace, const std::function<void(const Events&)>& handle);

    std::deque<Host>& hosts() { return hosts_; }

  private:
    void start_again(Host& host);
    void restart_due(Events& news);
    static std::chrono::milliseconds restart_delay(const Host& host);
    bool read_signals();
    void read_output(Host& host, Events& news);
    static void add_line(Host& host, Events& news);

    std::deque<Host> hosts_; // not a vector: references to a Host stay valid
    process::FileDescriptor signals_;
    std::optional<InputRelay> input_;
};

/// A signal asked this program to end.
class Interrupted : public std::runtime_error {
  public:
    Interrupted() : std::runtime_error("interrupted") {}
};

} // namespace tandem::hosts
