// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/control/background_program.hpp"
#include "apps/tandem/monitor/control/request_program.hpp"
#include "apps/tandem/monitor/control/systems.hpp"
#include "apps/tandem/monitor/state.hpp"
#include "host/process/child_process.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <functional>
#include <list>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::monitor {

/// Runs commands without blocking the server. [one thread]
class Programs {
  public:
    static constexpr std::size_t max_running = 8;
    static constexpr std::chrono::seconds max_time{15};
    static constexpr std::size_t max_output = 4 << 20; ///< bytes passed on: JSON of a large system

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

/// Executes the requests of clients with the token. docs/monitoring.md describes the requests. [one thread]
class Control {
  public:
    using Reply = std::function<void(const nlohmann::json&)>;

    /// `state`: returns the newest State. `systems`: the folder of systems; empty: none. Throws std::runtime_error if this
    /// folder does not exist, or if the system provides no random numbers.
    Control(boost::asio::io_context& context, std::function<const State&()> state,
            const std::string& systems);
    /// Ends what clients have started, cleanly.
    ~Control();
    Control(const Control&) = delete;
    Control& operator=(const Control&) = delete;

    const std::string& token() const { return token_; }
    /// Returns whether the text is the token. Compares in constant time.
    bool is_token(std::string_view text) const;

    /// Executes a JSON request. Calls `reply` once, now or later; for a stick position without an id only if it could not
    /// be sent. Each reply has the request's id.
    void handle(const std::string& text, const Reply& reply);

    /// Return the programs for clients of foxglove.websocket.v1. There are two, so that a long call does not delay messages.
    RequestProgram& publishing() { return publishing_; }
    RequestProgram& calling() { return calling_; }

    /// Returns what runs: {"allowed": true, "recording", "recording_since_ms", "replay", "systems"}. "replay": {"file",
    /// "running", "since_ms", "end"}, or null; "systems": as Systems::runs(), or null without a folder of systems.
    nlohmann::ordered_json status();
    /// Returns why the last recording has failed; empty if it has not.
    std::string recording_failure();

  private:
    // Each executes the requests with an `op` of docs/monitoring.md, as handle(). Throws std::exception for a bad one.
    void drive(const nlohmann::json& request, const Reply& reply);
    void run_tool(const nlohmann::json& request, const Reply& reply);
    void record(const nlohmann::json& request, const Reply& reply);
    void replay(const nlohmann::json& request, const Reply& reply);
    void change_systems(const nlohmann::json& request, const Reply& reply);
    void report(const nlohmann::json& request, const std::string& op, const Reply& reply) const;

    std::string recording();
    void run(const std::vector<std::string>& command, const nlohmann::json& request, const Reply& reply);

    std::function<const State&()> state_;
    std::string token_, program_;
    Programs programs_;
    RequestProgram publishing_, calling_;
    std::optional<BackgroundProgram> recorder_, player_;
    std::string recorded_file_, replayed_file_;
    process::FileDescriptor recorder_output_, player_output_;
    std::optional<Systems> systems_;
    process::FileDescriptor stick_socket_;
};

} // namespace tandem::monitor
