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

/// The directory of an application, for components that show other components elsewhere. [any-thread] unless stated
/// otherwise.
class ApplicationDirectory final : public ComponentDirectory {
  public:
    /// Each call reads the list, so the list must not change after the first call. `is_ending` returns whether the host
    /// was asked to end.
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

    /// Adds the connections that the application profile lists. Call it before any component can ask. [main-thread]
    void set_profile_connections(std::vector<ConnectionProfile> connections) {
        profile_connections_ = std::move(connections);
    }
    /// Ends all connections that components have requested. Removes these connections from the directory first, then waits
    /// for the calls under way.
    void disconnect_all() {
        decltype(ended_) ended;
        decltype(connections_) connections;
        const std::lock_guard lock(connections_mutex_); // released first
        ended.swap(ended_);
        connections.swap(connections_);
    }
    /// Leaks the connections, for a thread that does not return.
    void release_connections() {
        for (auto& [port, connection] : connections_) static_cast<void>(connection.release());
        for (auto& connection : ended_) static_cast<void>(connection.release());
    }

    /// Starts a component that has failed to start: see ComponentHost::start_again(). Returns false if that fails, or
    /// while transitions are refused.
    bool start_again(const std::string& name);

    /// Permits transitions. Until this call all transitions are refused.
    void open() { refusal_ = nullptr; }
    /// Refuses all transitions from now on and waits for the current ones. Returns false if that takes longer than
    /// `timeout`.
    bool close(std::chrono::nanoseconds timeout);

  private:
    ComponentHost* find_host(const std::string& name) const;

    const std::vector<std::unique_ptr<ComponentHost>>& components_;
    const std::function<bool()> is_ending_;
    std::vector<ConnectionProfile> profile_connections_;
    std::mutex connections_mutex_;
    std::map<Port*, std::unique_ptr<Connection>> connections_; ///< by the port of the component that asked
    std::vector<std::unique_ptr<Connection>> ended_;           ///< a call may be in one of these
    std::atomic<const char*> refusal_{"the application has not started yet"}; ///< NULL: transitions are made
    std::atomic<int> transitions_{0};                                         ///< current
};

} // namespace tandem::engine
