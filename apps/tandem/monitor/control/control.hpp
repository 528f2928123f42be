// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/control/programs.hpp"
#include "apps/tandem/monitor/control/request_program.hpp"
#include "apps/tandem/monitor/state.hpp"

#include <nlohmann/json.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace tandem::monitor {

/// Executes the requests of clients with the token. docs/monitoring.md describes the requests. [one thread]
class Control {
  public:
    using Reply = std::function<void(const nlohmann::json&)>;

    /// `state`: returns the newest State. Throws std::runtime_error if the system provides no random numbers.
    Control(boost::asio::io_context& context, std::function<const State&()> state);
    ~Control(); ///< ends a recording properly

    const std::string& token() const { return token_; }
    /// Compares in constant time.
    bool is_token(std::string_view text) const;

    /// Executes a JSON request. Calls `reply` once, now or later; for a stick position only if it could not be sent.
    void handle(const std::string& text, const Reply& reply);

    /// For clients of foxglove.websocket.v1. Two programs, so that a long call does not delay messages.
    RequestProgram& publishing() { return publishing_; }
    RequestProgram& calling() { return calling_; }

    /// Returns the file of the current recording; empty if there is none.
    std::string recording();

  private:
    void drive(const nlohmann::json& request, const Reply& reply);
    void run_rtm(const nlohmann::json& request, const Reply& reply);
    void record(const nlohmann::json& request, const Reply& reply);

    std::function<const State&()> state_;
    std::string token_, program_;
    Programs programs_;
    RequestProgram publishing_, calling_;
    std::optional<process::ChildProcess> recorder_;
    std::string recorded_file_;
    process::FileDescriptor stick_socket_;
};

} // namespace tandem::monitor
