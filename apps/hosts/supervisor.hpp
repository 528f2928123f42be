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

/// How a host is started.
struct HostCommand {
    std::string name; ///< for messages: opros_host or rtm_host
    std::vector<std::string> command;
    /// File for its standard error; empty: its standard error and its output come as Events::lines.
    std::string log;
    std::string folder{};                         ///< its working folder; empty: that of this program
    std::vector<std::string> restart_arguments{}; ///< further ones when it is started again and was ready
};

/// A host process, and what is needed to start it again.
struct Host : HostCommand {
    std::streamoff
        log_start; // offset at which this process began to write: a restarted host continues the file
    process::ChildProcess process;
    process::OutputPipe output; // its standard output
    std::string unread{};       // the beginning of an incomplete line of its output
    std::string last_line{};    // of its output
    double unread_since = 0.0;  // CLOCK_MONOTONIC [s] of the newest part of `unread`
    int blank_lines = 0;        // held back before it is ready: `ready` brings one
    double ready_at = 0.0;      // CLOCK_MONOTONIC [s] at which it wrote the line `ready`; 0: not yet
    bool ended = false;         // watch() has reported its end

    bool ready() const { return ready_at > 0.0; }
    bool running() const { return !ended; }
    std::string command_line() const; // for a user to type: quoted for a shell
    std::string first_error() const;  // first line with "error" that this process logged, else its last line
};

/// Starts, watches and stops hosts. While it exists, SIGINT, SIGTERM and SIGHUP of this program are blocked and
/// reported by watch() instead, so that the hosts can be stopped in order. [main-thread]
class Supervisor {
  public:
    Supervisor();
    ~Supervisor(); // stops the hosts that still run, in reverse start order

    /// What `source` has goes to all hosts that are started from here on, as their standard input.
    void relay_input(int source) { input_.emplace(source); }
    /// A log is appended to. Throws std::runtime_error when the host cannot be started.
    Host& start(const HostCommand& command);
    /// Starts a host that has ended once more, with the same command and log; with its restart_arguments if it was ready.
    void restart(Host& host);

    /// What has happened since the last call of watch().
    struct Events {
        std::vector<Host*> ended, became_ready;
        std::vector<std::pair<const Host*, std::string>> lines; // of hosts without a log
        bool interrupted = false;                               // a signal asked this program to end
    };
    /// Waits until something happens, at most `timeout`.
    Events watch(std::chrono::milliseconds timeout);

    /// Waits until all hosts, which have logs, are ready. Throws std::runtime_error with the host's first error when one
    /// ends or is not ready within `seconds`, and Interrupted when a signal asks this program to end.
    void wait_until_ready(double seconds);

    /// Sends SIGTERM, and SIGKILL if the host has not ended after 5 s. True if it exited with code 0.
    bool stop(Host& host);

    /// Sends SIGTERM to all hosts at once, and SIGKILL to those that have not ended within `grace` or when a signal, more
    /// than a second later, asks this program to end once more. `handle` is told what happens meanwhile. True if all exited with code 0.
    bool stop_all(std::chrono::milliseconds grace, const std::function<void(const Events&)>& handle);

    std::deque<Host>& hosts() { return hosts_; }

  private:
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
