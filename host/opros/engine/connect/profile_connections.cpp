// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/connect/profile_connections.hpp"

#include "host/log/log.hpp"
#include "host/opros/engine/connect/make_connection.hpp"
#include "host/process/published/inventory.hpp"

#include <algorithm>

namespace tandem::engine {

bool ProfileConnections::Entry::has_end(const ComponentHost& component, const std::string& port) const {
    return (source == &component && profile.source.port == port) ||
           (target == &component && profile.target.port == port);
}

/// The latest reason replaces the previous one.
void ProfileConnections::Entry::show_refusal(const std::string& reason) {
    problem = reason;
    refusal.reset();
    refusal =
        std::make_unique<process::OwnRefusedConnection>(profile.source.text(), profile.target.text(), reason);
}

void ProfileConnections::Watcher::portAdded(const std::string& name, Port& port) {
    owner.change({&component, name, &port});
}
void ProfileConnections::Watcher::portRemoved(const std::string& name, Port&) {
    owner.change({&component, name, nullptr});
}

void ProfileConnections::connect_all(std::vector<ConnectionProfile> connections, const Components& components,
                                     bool strict) {
    const auto find = [&](const std::string& name) -> ComponentHost* {
        const auto found = std::find_if(components.begin(), components.end(),
                                        [&](const auto& component) { return component->name() == name; });
        return found == components.end() ? nullptr : found->get();
    };
    busy_ = true; // from here on a bridge's thread may add ports; the loop below handles them
    for (const auto& component : components) {
        watchers_.push_back(std::make_unique<Watcher>(*this, *component));
        component->component().addPortListener(watchers_.back().get());
    }
    try {
        for (auto& connection : connections) {
            ComponentHost* source = find(connection.source.component);
            ComponentHost* target = find(connection.target.component);
            entries_.push_back({std::move(connection), source, target});
            connect_at_setup(entries_.back(), strict);
        }
    } catch (const SetupError&) {
        const std::lock_guard lock(mutex_);
        busy_ = false; // otherwise disconnect_all() would wait for this thread
        throw;
    }
    publish_statuses();
    apply_changes();
}

void ProfileConnections::publish_statuses() {
    std::vector<Status> statuses;
    for (const auto& entry : entries_) {
        const PortReference &source = entry.profile.source, &target = entry.profile.target;
        statuses.push_back({entry.profile.type, source, target, entry.connection ? "" : entry.problem});
        if (entry.connection)
            process::list_part(&entry,
                               {"connection", source.component, source.port, target.component, target.port});
        else
            process::unlist_part(&entry);
    }
    const std::lock_guard lock(mutex_);
    statuses_ = std::move(statuses);
}

std::vector<ProfileConnections::Status> ProfileConnections::statuses() const {
    const std::lock_guard lock(mutex_);
    return statuses_;
}

void ProfileConnections::connect_at_setup(Entry& entry, bool strict) {
    const auto& profile = entry.profile;
    try {
        if (!profile.error.empty()) throw SetupError(profile.location, profile.error);
        const bool has_source = entry.source && !entry.source->has_failed();
        if (has_source && entry.target && !entry.target->has_failed())
            entry.connection = make_connection(profile, *entry.source, *entry.target);
        else {
            entry.show_refusal("component " + (has_source ? profile.target : profile.source).component +
                               " has failed");
            log::warn("{}: connection left out, {}", profile.location.text(), entry.problem);
        }
    } catch (const NoSuchPort& error) {
        if (strict) throw;
        entry.waits_for_port = true;
        entry.show_refusal(error.what());
        log::error("{}; this connection is left out until the port is added, and the others are made",
                   error.what());
    } catch (const SetupError& error) {
        if (strict) throw;
        entry.show_refusal(error.what());
        log::error("{}; this connection is left out, and the others are made", error.what());
    }
}

/// If another thread is at work, this thread leaves the change to it. So no thread waits for another thread here.
void ProfileConnections::change(Change change) {
    {
        const std::lock_guard lock(mutex_);
        if (closed_) return;
        changes_.push_back(std::move(change));
        if (busy_) return;
        busy_ = true;
    }
    apply_changes();
}

void ProfileConnections::apply_changes() {
    for (;;) {
        Change next{};
        {
            const std::lock_guard lock(mutex_);
            if (changes_.empty() || closed_) {
                busy_ = false;
                idle_.notify_all();
                return;
            }
            next = std::move(changes_.front());
            changes_.pop_front();
        }
        apply(next);
        publish_statuses();
    }
}

void ProfileConnections::apply(const Change& change) {
    if (change.added) {
        change.component->add_data_port(change.port, *change.added);
        for (auto& entry : entries_)
            if (entry.waits_for_port && entry.has_end(*change.component, change.port)) connect_late(entry);
        return;
    }
    std::size_t ended = 0;
    for (auto& entry : entries_) {
        if (!entry.has_end(*change.component, change.port)) continue;
        // Also retries a connection whose types did not match, because the port may come back with another type.
        if (!entry.connection && entry.profile.error.empty()) entry.waits_for_port = true;
        if (!entry.connection) continue;
        disconnect(entry);
        ++ended;
    }
    change.component->remove_data_port(change.port);
    dropped_ += ended;
    if (ended != 0)
        log::warn(
            "port {}.{} was removed: {} of its connections end, {} so far; they are made again when it is "
            "added again",
            change.component->name(), change.port, ended, dropped_);
}

void ProfileConnections::connect_late(Entry& entry) {
    if (!entry.source || !entry.target || entry.source->has_failed() || entry.target->has_failed()) return;
    const std::string text = entry.profile.source.text() + " -> " + entry.profile.target.text();
    try {
        entry.connection = make_connection(entry.profile, *entry.source, *entry.target);
        entry.waits_for_port = false;
        entry.refusal.reset();
        log::info("connection {} is made: its port was added", text);
    } catch (const NoSuchPort&) { // the port at the other end does not exist yet
    } catch (const SetupError& error) {
        entry.waits_for_port = false;
        entry.show_refusal(error.what());
        log::error("{}; connection {} is left out", error.what(), text);
    }
}

void ProfileConnections::disconnect(Entry& entry) {
    const bool may_be_in_use = entry.connection->disconnect();
    if (may_be_in_use) ended_.push_back(std::move(entry.connection));
    entry.connection.reset();
    entry.waits_for_port = true;
    entry.show_refusal("a port was removed; the connection is made again when it is added");
}

bool ProfileConnections::disconnect_all(std::chrono::nanoseconds timeout) {
    {
        std::unique_lock lock(mutex_);
        closed_ = true;
        if (!idle_.wait_for(lock, timeout, [this] { return !busy_; })) return false;
    }
    for (const auto& watcher : watchers_) watcher->component.component().removePortListener(watcher.get());
    watchers_.clear();
    for (const auto& entry : entries_) process::unlist_part(&entry);
    entries_.clear();
    ended_.clear();
    return true;
}

} // namespace tandem::engine
