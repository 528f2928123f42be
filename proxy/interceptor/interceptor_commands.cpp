// SPDX-License-Identifier: Apache-2.0
// InterceptorComp: what it does when the peer connects, disconnects and calls.
#include "host/log/log.hpp"
#include "proxy/interceptor/interceptor_comp.hpp"
#include "proxy/link/protocol/control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>

namespace tandem::interceptor {
namespace control = link::control;
using link::CallStatus;
using link::Reply;

namespace {

// What the other process shares costs memory and names in this one.
constexpr std::size_t max_shown_components = 256;

} // namespace

/// Refuses a table that has a port of the same name, because the channels of both share one segment.
std::string InterceptorComp::check_peer_ports(link::PortTable& peer) {
    {
        const std::lock_guard lock(channel_keys_mutex_);
        for (const auto& port : peer.ports)
            if (channel_ports_.contains(port.name))
                return fmt::format(
                    "link '{}': both sides share a port '{}'; rename the OPRoS component or the RTC",
                    settings_.link, port.name);
    }
    if (peer.components.size() > max_shown_components)
        return fmt::format("link '{}': the peer shares {} components, at most {} are shown as RTCs",
                           settings_.link, peer.components.size(), max_shown_components);
    opros_rtcs_->set_peer_table(peer, !link_->is_up());
    return "";
}

void InterceptorComp::link_state_changed(bool up) {
    if (up) log::info("{}: link '{}' is up", getInstanceName(), settings_.link);
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    link_state_.tm.sec = static_cast<CORBA::ULong>(now.tv_sec);
    link_state_.tm.nsec = static_cast<CORBA::ULong>(now.tv_nsec);
    // Both sides stamp with CLOCK_MONOTONIC, which all processes of a machine share: the times can be compared.
    link_state_.data.length(3);
    link_state_.data[0] = static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    link_state_.data[1] = static_cast<double>(++link_state_sequence_);
    link_state_.data[2] = up ? 1.0 : 0.0;
    link_state_out_.write();
}

void InterceptorComp::deadline_missed(const std::string& port) {
    setTimestamp(missed_deadline_);
    missed_deadline_.data = port.c_str();
    missed_deadline_out_.write();
}

void InterceptorComp::peer_disconnected() {
    for (auto& port : required_) port->unbind();
    opros_rtcs_->peer_lost();
    activation_->peer_lost();
}

namespace {

/// The ORB would make the worker known to itself for each call anew, which takes as long as the call.
void make_worker_known_to_orb() { thread_local const omni_thread::ensure_self known_to_orb; }

} // namespace

[[gnu::hot]] std::optional<link::ReplyView> InterceptorComp::serve_known(const link::KnownRequest& request,
                                                                         wire::MessageBuffer& memory) {
    if (auto* port = provided_by_name_.find(request.id.port)) return port->serve_known(request, memory);
    return std::nullopt;
}

Reply InterceptorComp::serve(const link::Request& request) {
    make_worker_known_to_orb();
    if (request.port.empty()) return execute_command(request);
    if (auto* port = provided_by_name_.find(request.port)) return port->serve(request);
    for (const auto& service : built_in_services_)
        if (service.port().name == request.port) return service.serve(request);
    return opros_rtcs_->serve(request);
}

Reply InterceptorComp::execute_command(const link::Request& request) {
    std::string error;
    try {
        if (request.operation == control::activate) {
            error = activation_->activate();
        } else if (request.operation == control::deactivate) {
            error = activation_->deactivate();
        } else if (request.operation == control::reset) {
            error = activation_->reset();
        } else if (request.operation == control::state) {
            opros_rtcs_->receive_state(request);
        } else if (request.operation == control::bind) {
            error = bind(request.arguments);
        } else if (request.operation == control::listen) {
            link_->serve_listen(request.arguments);
        } else {
            return Reply::failure(CallStatus::no_such_operation, "unknown command");
        }
    } catch (const link::LinkError& damaged) {
        error = damaged.what();
    }
    return error.empty() ? Reply{} : Reply::failure(CallStatus::exception, error);
}

std::string InterceptorComp::bind(std::span<const std::byte> arguments) {
    try {
        const auto binding = control::decode_service_binding(arguments);
        if (auto* port = required_by_name_.find(binding.port)) {
            port->bind(binding);
            return "";
        }
        return fmt::format("there is no required service port '{}'", binding.port);
    } catch (const std::runtime_error& error) { // damaged binding, malformed signature
        return error.what();
    }
}

/// Asks the peer to ring the doorbell for the ports whose messages are handed over when they come. [task-thread]
void InterceptorComp::publish_listened_channels() {
    if (!link_->is_up()) return; // peer_connected() comes here again
    auto channels = opros_rtcs_->listened_channels();
    for (const auto& [name, mirror] : data_ports_)
        if (mirror.shown && mirror.forward) channels.push_back(name);
    const auto reply = link_->request_rings(channels, control::command_timeout(settings_.call_timeout));
    if (reply.status != CallStatus::ok && link_->is_up())
        log::warn("{}: data and events of OPRoS components are handed over up to 1 s late: {}",
                  getInstanceName(), reply.text());
}

void InterceptorComp::peer_ports_changed() { opros_rtcs_->update_ports(); }

void InterceptorComp::peer_connected() {
    opros_rtcs_->peer_connected();
    publish_listened_channels();
    failures_->send(); // there may have been no peer when it happened
}

} // namespace tandem::interceptor
