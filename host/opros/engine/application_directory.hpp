// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/connect/connection.hpp"
#include "host/opros/engine/execute/component_host.hpp"
#include "host/opros/engine/profile/application_profile.hpp"

#include <ComponentDirectory.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace tandem::engine {

/// The directory of an application, for components that show others elsewhere. [any-thread] where nothing else is said.
class ApplicationDirectory final : public ComponentDirectory {
  public:
    /// The list is read at each call and must not change from the first one on. `is_ending`: whether the host was asked to
    /// end.
    explicit ApplicationDirectory(const std::vector<std::unique_ptr<ComponentHost>>& components,
                                  std::function<bool()> is_ending)
        : components_(components), is_ending_(std::move(is_ending)) {}

    std::vector<std::string> names() const override;
    Component* find(const std::string& name) override;
    std::string type(const std::string& name) const override;
    std::string transition(const std::string& name, ComponentTransition transition) override;
    bool setProperty(const std::string& component, const std::string& name,
                     const std::string& value) override;

    bool isEnding() const override { return is_ending_(); }
    bool isConnected(const std::string& component, const std::string& port) const override;
    std::string connect(const std::string& owner, Port& port, const std::string& component,
                        const std::string& component_port) override;
    void disconnect(Port& port) override;

    /// What the application profile connects. [main-thread] Before any component can ask.
    void set_profile_connections(std::vector<ConnectionProfile> connections) {
        profile_connections_ = std::move(connections);
    }
    /// Ends all connections that components have asked for. [main-thread]
    void disconnect_all() {
        connections_.clear();
        ended_.clear();
    }
    /// Leaves them in memory, for a thread that does not return.
    void release_connections() {
        for (auto& [port, connection] : connections_) static_cast<void>(connection.release());
        for (auto& connection : ended_) static_cast<void>(connection.release());
    }

    /// Before this all transitions are refused.
    void open() { refusal_ = nullptr; }
    /// Refuses all transitions from now on, and waits for those under way. False if that takes longer than `timeout`.
    bool close(std::chrono::nanoseconds timeout);

  private:
    ComponentHost* find_host(const std::string& name) const;

    const std::vector<std::unique_ptr<ComponentHost>>& components_;
    const std::function<bool()> is_ending_;
    std::vector<ConnectionProfile> profile_connections_;
    std::mutex connections_mutex_;
    std::map<Port*, std::unique_ptr<Connection>> connections_; ///< by the port of the component that asked
    std::vector<std::unique_ptr<Connection>> ended_;           ///< in which a call may still be
    std::atomic<const char*> refusal_{"the application has not started yet"}; ///< NULL: transitions are made
    std::atomic<int> transitions_{0};                                         ///< under way
};

} // namespace tandem::engine
