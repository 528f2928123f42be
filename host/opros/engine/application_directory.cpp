// SPDX-License-Identifier: Apache-2.0
#include "host/opros/engine/application_directory.hpp"

#include "host/opros/engine/connect/make_connection.hpp"

#include <RequiredServicePort.h>

#include <algorithm>
#include <stdexcept>
#include <thread>

namespace tandem::engine {

std::vector<std::string> ApplicationDirectory::names() const {
    std::vector<std::string> names;
    for (const auto& component : components_) names.push_back(component->name());
    return names;
}

ComponentHost* ApplicationDirectory::find_host(const std::string& name) const {
    for (const auto& component : components_)
        if (component->name() == name) return component.get();
    return nullptr;
}

Component* ApplicationDirectory::find(const std::string& name) {
    ComponentHost* host = find_host(name);
    return host ? &host->component() : nullptr;
}

std::string ApplicationDirectory::type(const std::string& name) const {
    const ComponentHost* host = find_host(name);
    return host ? host->profile().name : "";
}

std::string ApplicationDirectory::transition(const std::string& name, ComponentTransition transition) {
    ComponentHost* host = find_host(name);
    if (!host) return "there is no component " + name;
    // Counts before it reads refusal_: either close() sees the count, or this function sees the refusal.
    ++transitions_;
    const char* refusal = refusal_;
    std::string error = refusal ? refusal : host->request(transition);
    --transitions_;
    return error;
}

bool ApplicationDirectory::start_again(const std::string& name) {
    ComponentHost* host = find_host(name);
    ++transitions_; // before refusal_ is read, as in transition()
    const bool started = !refusal_ && host && host->start_again();
    --transitions_;
    return started;
}

bool ApplicationDirectory::setProperty(const std::string& component, const std::string& name,
                                       const std::string& value) {
    ComponentHost* host = find_host(component);
    if (host) host->set_property(name, value);
    return host != nullptr;
}

bool ApplicationDirectory::isConnected(const std::string& component, const std::string& port) const {
    return std::any_of(profile_connections_.begin(), profile_connections_.end(), [&](const auto& connection) {
        return connection.source.component == component && connection.source.port == port;
    });
}

std::string ApplicationDirectory::connect(const std::string& owner, Port& port, const std::string& component,
                                          const std::string& component_port) {
    ComponentHost *own = find_host(owner), *host = find_host(component);
    Port* other = host ? host->component().getPort(component_port) : nullptr;
    if (!own || !other) return "there is no port " + component + "." + component_port;
    const bool is_required = dynamic_cast<RequiredServicePort*>(other) != nullptr;
    const std::lock_guard lock(connections_mutex_);
    try {
        connections_[&port] =
            is_required ? make_connection(*other, port, *own) : make_connection(port, *other, *host);
        return "";
    } catch (const std::runtime_error& error) {
        connections_.erase(&port);
        return error.what();
    }
}

void ApplicationDirectory::disconnect(Port& port) {
    std::unique_ptr<Connection> connection;
    {
        const std::lock_guard lock(connections_mutex_);
        const auto found = connections_.find(&port);
        if (found == connections_.end()) return;
        connection = std::move(found->second);
        connections_.erase(found);
    }
    // Without the lock: this may wait for a call of a component that connects ports.
    if (!connection->disconnect()) return;
    const std::lock_guard lock(connections_mutex_);
    ended_.push_back(std::move(connection));
}

bool ApplicationDirectory::close(std::chrono::nanoseconds timeout) {
    refusal_ = "the application ends";
    const auto deadline = std::chrono::steady_clock::now() + timeout;
    while (transitions_ > 0 && std::chrono::steady_clock::now() < deadline)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return transitions_ == 0;
}

} // namespace tandem::engine
