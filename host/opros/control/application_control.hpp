// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/control/port_list.hpp"
#include "host/opros/engine/application.hpp"

#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>

namespace tandem::control {

/// Answers requests about an application that has started: see the README of this folder. Destroy it after the
/// application is shut down and before it is unloaded. [any-thread] unless stated otherwise.
class ApplicationControl {
  public:
    /// `profile` is the application's file, for people. [main-thread]
    ApplicationControl(engine::Application& application, const std::string& profile);

    /// Executes a request and returns its reply. Life-cycle commands run callbacks of the component.
    std::string answer(const std::string& request);
    /// Returns the time limit of a request.
    static std::chrono::milliseconds time_limit(const std::string& request);
    /// Returns whether the request may run a callback of a component.
    static bool runs_callback(const std::string& request);
    /// Returns the reply to a request that has not ended in this time.
    std::string late_reply(const std::string& request);
    /// Refuses to read and to set properties from now on: the end of the application calls components outside of their
    /// cycles. Waits for a few seconds while one is read or set.
    void close();

  private:
    nlohmann::json execute(const nlohmann::json& request);
    nlohmann::json list();
    nlohmann::json info(engine::ComponentHost& component);
    nlohmann::json read_properties(engine::ComponentHost& component);
    nlohmann::json make_transition(engine::ComponentHost& component, const std::string& command);
    nlohmann::json configure(engine::ComponentHost& component, const nlohmann::json& request);
    void set_property(engine::ComponentHost& component, const std::string& name, const std::string& value);
    engine::ComponentHost& find(const nlohmann::json& request);

    engine::Application& application_;
    const engine::ProfileConnections& connections_;
    const std::string profile_;
    std::map<std::string, std::unique_ptr<PortList>> ports_; ///< by component
    std::mutex properties_mutex_;                            ///< held while properties are used
    bool closed_ = false;                                    ///< guarded by properties_mutex_
};

} // namespace tandem::control
