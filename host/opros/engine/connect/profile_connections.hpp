// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/connect/connection.hpp"
#include "host/opros/engine/execute/component_host.hpp"
#include "host/opros/engine/profile/application_profile.hpp"
#include "host/process/refused_connections.hpp"

#include <PortListener.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace tandem::engine {

/// The connections that the application profile names. They are made when the application is set up; one whose port a
/// component adds later, at that time, in the thread that adds it. When a port is removed its connections end; they are tried
/// again when it comes back, also those whose types did not match. Other processes can see which were not made
/// (host/process/refused_connections.hpp). Before the components are deleted, disconnect_all() must have returned true.
class ProfileConnections {
  public:
    using Components = std::vector<std::unique_ptr<ComponentHost>>;
    ProfileConnections() = default;
    ProfileConnections(const ProfileConnections&) = delete;
    ProfileConnections& operator=(const ProfileConnections&) = delete;

    /// Watches the ports of the components, and makes the connections. One that cannot be made is logged in one line, or with
    /// `strict` ends the set-up: throws SetupError. The components must outlive this object. [main-thread]
    void connect_all(std::vector<ConnectionProfile> connections, const Components& components, bool strict);
    /// Ends all connections, and makes no others. False if a change under way takes longer than `timeout`. When no component
    /// runs any more. [main-thread]
    bool disconnect_all(std::chrono::nanoseconds timeout);

  private:
    struct Entry {
        ConnectionProfile profile;
        ComponentHost *source = nullptr, *target = nullptr; ///< nullptr: it could not be loaded
        std::unique_ptr<Connection> connection{};           ///< nullptr: not made
        bool waits_for_port = false;
        std::unique_ptr<process::OwnRefusedConnection> refusal{}; ///< shows others why it was not made

        void show_refusal(const std::string& reason);
        bool has_end(const ComponentHost& component, const std::string& port) const;
    };
    struct Change {
        ComponentHost* component;
        std::string port;
        Port* added; ///< nullptr: it was removed
    };
    /// The listener to the ports of one component.
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
    void apply(const Change& change);
    void connect_late(Entry& entry);
    void disconnect(Entry& entry);

    std::vector<std::unique_ptr<Watcher>> watchers_;
    // Changed by one thread at a time: the one that has set busy_.
    std::vector<Entry> entries_;
    std::vector<std::unique_ptr<Connection>> ended_; ///< in which a call may still be
    std::size_t dropped_ = 0;                        ///< connections whose port was removed

    std::mutex mutex_; ///< the members below
    std::condition_variable idle_;
    std::deque<Change> changes_; ///< not applied yet
    bool busy_ = false;          ///< a thread applies changes, those that others append included
    bool closed_ = false;
};

} // namespace tandem::engine
