// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/monitor/control/request_program.hpp"
#include "apps/tandem/monitor/foxglove/client_line.hpp"
#include "apps/tandem/monitor/state.hpp"

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>

namespace tandem::monitor {

/// Configuration parameters of RTCs and properties of OPRoS components on links, as parameters `/LINK/COMPONENT/NAME`
/// of the specification. [one thread]
class ClientParameters : public std::enable_shared_from_this<ClientParameters> {
  public:
    static constexpr std::size_t max_names = 1000;     ///< limit for a client's subscriptions
    static constexpr std::size_t max_components = 256; ///< limit for one read
    /// Polling interval of subscribed parameters, because hosts do not report changes.
    static constexpr std::chrono::seconds poll_interval{1};

    /// `state`: returns the newest State.
    ClientParameters(std::function<const State&()> state, RequestProgram& program, ClientLine line)
        : state_(std::move(state)), program_(program), line_(std::move(line)) {}

    // Messages of the specification. They throw nlohmann::json::exception for any other JSON.
    void get(const nlohmann::json& request);
    void set(const nlohmann::json& request);
    void subscribe(const nlohmann::json& request);
    void unsubscribe(const nlohmann::json& request);
    /// Call this often.
    void poll();

  private:
    using Names = std::set<std::string>;
    using Values = std::map<std::string, nlohmann::json>;
    /// Reads the parameters with these names, or all. Passes those that exist to `done`.
    void read(const Names& names, const std::function<void(const Values&)>& done);
    void send_values(const Values& values, const nlohmann::json& request);

    const std::function<const State&()> state_;
    RequestProgram& program_;
    const ClientLine line_;
    Names subscribed_;
    Values sent_; ///< values of subscribed_ that the client knows
    bool reading_ = false;
    std::chrono::steady_clock::time_point next_poll_{};
};

} // namespace tandem::monitor
