// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <ios>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/process/child_process.hpp"
#include "host/process/output_pipe.hpp"

namespace tandem::wheelchair {

/// A host process of the run, and how to start it (again).
struct Host {
    std::string name;
    std::vector<std::string> command;
    std::string log;          // file with its stderr
    std::streamoff log_start; // where this process's part of it begins
    process::ChildProcess process;
    process::OutputPipe output; // its stdout
    std::string unread{};       // beginning of a line of its stdout
    double ready_at = 0.0;      // CLOCK_MONOTONIC [s] of its line `ready`; 0: not yet
    bool ended = false;         // its end was reported by watch()

    bool ready() const { return ready_at > 0.0; }
    bool running() const { return !ended; }
    std::string command_line() const; // quoted for a shell
    std::string first_error() const;  // first error in its log, else the last line
};

/// Starts hosts, watches them, and ends them. Takes over SIGINT, SIGTERM and SIGHUP of this program while it
/// lives.
class Supervisor {
  public:
    Supervisor();
    ~Supervisor(); // stops what still runs, last started first

    Host& start(const std::string& name, const std::vector<std::string>& command, const std::string& log);
    /// Starts an ended host once more, same command, log continued.
    void restart(Host& host);

    struct Events {
        std::vector<Host*> ended, became_ready;
        bool interrupted = false;
    };
    /// Waits for news, at most `bound`.
    Events watch(std::chrono::milliseconds bound);

    /// Until all hosts are ready. Throws InputError with the host's last words when one ends before, when
    /// `seconds` are over, or when the user interrupts.
    void wait_until_ready(double seconds);

    /// SIGTERM, bounded wait, SIGKILL. True if it ended by itself with exit code 0.
    bool stop(Host& host);

    std::deque<Host>& hosts() { return hosts_; }

  private:
    void read_output(Host& host, Events& news);

    std::deque<Host> hosts_; // a deque: Hosts stay where they are
    process::FileDescriptor signals_;
};

/// This program was asked to end.
class Interrupted : public std::runtime_error {
  public:
    Interrupted() : std::runtime_error("interrupted") {}
};

} // namespace tandem::wheelchair
