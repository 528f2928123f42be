// SPDX-License-Identifier: Apache-2.0
// AdaptorComp: the commands that it sends to the peer, and those that the peer sends.
#include "proxy/adaptor/adaptor_comp.hpp"

#include "host/log/log.hpp"
#include "proxy/adaptor/service/call_failure.hpp"
#include "proxy/link/protocol/control.hpp"

#include <algorithm>
#include <ctime>

namespace tandem::adaptor {
namespace control = link::control;
using link::CallStatus;
using link::peer_has_gone;
using link::Reply;
using namespace std::chrono_literals;

/// An activation waits for the execution contexts of two components, and for a call that the RTC may make from its
/// onActivated, so it gets the time of several calls. A transition waits for a callback of the RTC, whose time the peer
/// limits; an activation first waits for the deactivation caused by the last peer's end. Each gets one more second for the
/// answer.
std::chrono::milliseconds AdaptorComp::timeout_of(std::string_view command) {
    const auto rtcs = static_cast<int>(peer_ports().components.size());
    const auto begun = rtcs * control::head_start; // when the last one begins
    if (command == control::activate)
        return begun + std::max(4 * settings_.call_timeout,
                                control::activation_timeout + control::deactivation_timeout + 1s);
    if (command == control::deactivate || command == control::reset)
        return begun + std::max(settings_.call_timeout, control::deactivation_timeout + 1s);
    return control::command_timeout(settings_.call_timeout);
}

Reply AdaptorComp::send_command(std::string_view command, std::span<const std::byte> arguments) {
    return link_->call({"", command, "", arguments}, timeout_of(command));
}

/// Tells the peer which operations this side provides for the services that the RTC requires. Returns the failure if the
/// peer could not be told. A service that the peer refuses is left out, unless `strict` is set.
Reply AdaptorComp::publish_bindings() {
    for (const auto* port : mirrors_->required()) {
        Reply reply = send_command(
            control::bind, control::encode(control::ServiceBinding{port->port(), port->operations()}));
        if (reply.status == CallStatus::ok) continue;
        if (settings_.strict || reply.status != CallStatus::exception) return reply;
        log::error("{}: {}; this service is left out, and the others work", getId(),
                   describe_failure(reply, timeout_of(control::bind)));
    }
    return {};
}

/// Called when a service that the RTC requires is connected after the RTC was activated. [task-thread]
void AdaptorComp::publish_late_bindings() {
    if (!run_state_.is_running() || !link_->is_up())
        return; // the thread that activates the RTC publishes them
    const auto reply = publish_bindings();
    if (reply.status != CallStatus::ok && !peer_has_gone(reply.status))
        log::error("{}: link '{}': a service that was connected late cannot be called: {}", getId(),
                   settings_.link, describe_failure(reply, timeout_of(control::bind)));
}

/// Executes a life-cycle command on the RTC. Logs one line if it fails, unless the peer has gone, which the link reports.
CallStatus AdaptorComp::drive_rtc(std::string_view command) {
    // The RTC may call a service in its onActivated, so the peer must know the operations before.
    Reply reply = command == control::activate ? publish_bindings() : Reply{};
    const bool bound = reply.status == CallStatus::ok;
    if (bound) reply = send_command(command);
    if (reply.status != CallStatus::ok && (command == control::reset || !peer_has_gone(reply.status)))
        log::error("{}: link '{}': cannot {} {}: {}", getId(), settings_.link, command,
                   peer_ports().component_names(),
                   describe_failure(reply, timeout_of(bound ? command : control::bind)));
    return reply.status;
}

/// Called by a MirrorOutPort under the lock of the connected input port: must not wait.
void AdaptorComp::listen_to(const link::Port& port, engine::ArrivalListener* listener) {
    listeners_->set(link_->reader(port), listener);
    {
        const std::lock_guard lock(listened_ports_mutex_);
        if (listener)
            listened_ports_.insert(port.name);
        else
            listened_ports_.erase(port.name);
    }
    link_->post([this] { publish_listened_ports(); });
}

/// Asks the peer to ring the doorbell for the ports that event-driven components wait for. [task-thread]
void AdaptorComp::publish_listened_ports() {
    std::vector<std::string> ports;
    {
        const std::lock_guard lock(listened_ports_mutex_);
        ports.assign(listened_ports_.begin(), listened_ports_.end());
    }
    if (!link_->is_up()) return; // peer_connected() calls this function again
    const auto reply = link_->request_rings(ports, timeout_of(control::listen));
    if (reply.status != CallStatus::ok && !peer_has_gone(reply.status) && link_->is_up())
        log::warn("{}: link '{}': event-driven components notice arrivals up to 1 s late: {}", getId(),
                  settings_.link, describe_failure(reply, timeout_of(control::listen)));
}

void AdaptorComp::publish_link_state() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    const std::lock_guard lock(link_state_mutex_);
    // Read under the lock, so that of two threads the one with the newer state sends last.
    const bool up = link_->is_up();
    const double stamp = static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    link_state_.push(std::vector<double>{stamp, static_cast<double>(++link_state_sequence_), up ? 1.0 : 0.0});
}

} // namespace tandem::adaptor
