// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/process/child_process.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>

#include <chrono>
#include <functional>
#include <list>
#include <string>
#include <vector>

namespace tandem::monitor {

/// Runs commands without blocking the server. [one thread]
class Programs {
  public:
    static constexpr std::size_t max_running = 4;
    static constexpr std::chrono::seconds max_time{15};
    static constexpr std::size_t max_output = 16 << 10; ///< bytes passed on

    /// Called with the command's success (exit code 0) and its output, including errors.
    using Done = std::function<void(bool success, const std::string& output)>;

    explicit Programs(boost::asio::io_context& context) : timer_(context) {}
    /// Calls `done` once, later. Calls it at once if max_running commands are running or the command cannot be started.
    void run(const std::vector<std::string>& command, Done done);

  private:
    struct Job {
        process::ChildProcess child;
        process::FileDescriptor output;
        std::chrono::steady_clock::time_point end;
        Done done;
    };
    void look();

    boost::asio::steady_timer timer_;
    std::list<Job> jobs_;
};

} // namespace tandem::monitor
