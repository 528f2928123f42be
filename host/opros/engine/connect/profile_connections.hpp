// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/connect/connection.hpp"
#include "host/opros/engine/execute/component_host.hpp"
#include "host/opros/engine/profile/application_profile.hpp"
#include "host/process/published/refused_connections.hpp"

#include <PortListener.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace tandem::engine {

/// Keeps the connections that the application profile lists. They are made when the application is set up. If a
/// component adds a port later, its connections are made then, in the thread that adds the port. When a port is
/// removed, its connections end. When the port comes back, they are tried again, even if their types did not match
/// before. Other processes can see which connections were not made (host/process/published/refused_connections.hpp).
/// disconnect_all() must have returned true before the components are deleted.
class ProfileConnections {
  public:
    using Components = std::vector<std::unique_ptr<ComponentHost>>;
    ProfileConnections() = default;
    ProfileConnections(const ProfileConnections&) = delete;
    ProfileConnections& operator=(const ProfileConnections&) = delete;

    /// Watches the ports of the components and makes the connections. A connection that cannot be made is logged in one
    /// line or, with `strict`, throws SetupError and so ends the set-up. The components must outlive this object.
    /// [main-thread]
    void connect_all(std::vector<ConnectionProfile> connections, const Components& components, bool strict);
    /// Ends all connections and makes no new ones. Call it when no component runs any more. Returns false if a change
    /// in another thread takes longer than `timeout`. [main-thread]
    bool disconnect_all(std::chrono::nanoseconds timeout);

    /// A connection of the profile, and why it is not made; empty: it is.
    struct Status {
        PortType type;
        PortReference source, target;
        std::string problem;
    };
    /// Returns all connections of the profile as they were after the last change. [any-thread]
    std::vector<Status> statuses() const;

  private:
    struct Entry {
        ConnectionProfile profile;
        ComponentHost *source = nullptr, *target = nullptr; ///< nullptr: the component could not be loaded
        std::unique_ptr<Connection> connection{};           ///< nullptr: not made
        bool waits_for_port = false;
        std::string problem{};                                    ///< if the connection is not made
        std::unique_ptr<process::OwnRefusedConnection> refusal{}; ///< for other processes

        void show_refusal(const std::string& reason);
        bool has_end(const ComponentHost& component, const std::string& port) const;
    };
    struct Change {
        ComponentHost* component;
        std::string port;
        Port* added; ///< nullptr: the port was removed
    };
    /// Listens to the ports of one component.
    struct Watcher final : PortListener {
        Watcher(ProfileConnections& of, ComponentHost& host) : owner(of), component(host) {}
        void portAdded(const std::string& name, Port& port) override;
        void portRemoved(const std::string& name, Port& port) override;
        ProfileConnections& owner;
        ComponentHost& component;
    };

    void connect_at_setup(Entry& entry, bool strict);
    void change(Change change);
    void apply_changes();
    void publish_statuses();
    void apply(const Change& change);
    void connect_late(Entry& entry);
    void disconnect(Entry& entry);

    std::vector<std::unique_ptr<Watcher>> watchers_;
    // Only the thread that has set busy_ changes these members.
    std::vector<Entry> entries_;
    std::vector<std::unique_ptr<Connection>> ended_; ///< a call may still be in one of these
    std::size_t dropped_ = 0;                        ///< connections whose port was removed

    mutable std::mutex mutex_; ///< guards the members below
    std::vector<Status> statuses_;
    std::condition_variable idle_;
    std::deque<Change> changes_; ///< not applied yet
    bool busy_ = false;          ///< a thread applies the changes, including those that other threads append
    bool closed_ = false;
};

} // namespace tandem::engine
