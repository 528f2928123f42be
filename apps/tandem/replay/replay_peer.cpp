// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/replay/replay_peer.hpp"

#include "host/log/log.hpp"
#include "host/text/join.hpp"
#include "proxy/link/protocol/control.hpp"
#include "proxy/link/wait_mode.hpp"
#include "shm/inspect/observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

namespace tandem::command {
namespace {

namespace control = link::control;
using link::CallStatus;
using link::PortKind;
using link::Reply;
using namespace std::chrono_literals;

constexpr auto call_timeout = 5s;
/// Maximum message length in a ring: unknown, because the recording contains it only at its end.
constexpr std::size_t large_bytes = 0;

link::LinkOptions options_of(const std::string& name) {
    link::LinkOptions options;
    options.name = name;
    options.rings.large_bytes = large_bytes;
    options.wait = link::wait_options_from_environment();
    return options;
}

/// Returns a port's type for a message.
std::string type_of(const link::Port& port) {
    if (link::is_data_port(port.kind)) return port.signature;
    const std::string text = text::join(port.operations, "; ", [](const auto& operation) {
        return operation.name + " " + operation.signature;
    });
    return text.empty() ? "no operations" : text;
}

} // namespace

ReplayPeer::ReplayPeer(const RecordedLink& recorded, const std::string& name, shm::Side side,
                       Answers& answers, Comparison* check)
    : recorded_(recorded), name_(name), side_(side), answers_(answers), check_(check),
      link_(side, options_of(name), recorded.table(side), static_cast<link::LinkHandler&>(*this)) {
    for (const shm::Side owner : {side, shm::other(side)})
        for (const auto& port : recorded.table(owner).ports)
            if (port.has_ring() && (port.kind == PortKind::data_in) == (owner == side))
                received_ports_.push_back(port.name);
}

void ReplayPeer::open() {
    try {
        link_.open();
    } catch (const shm::SideTaken& taken) {
        throw std::runtime_error(
            fmt::format("link '{}': {}, which the replay replaces, is still running; stop it first ({})",
                        name_, recorded_.host_of(side_), taken.what()));
    }
}

void ReplayPeer::wait_until_active(std::chrono::milliseconds timeout, const std::function<bool()>& gives_up) {
    const auto deadline = std::chrono::steady_clock::now() + timeout;
    const std::string peer = recorded_.host_of(shm::other(side_));
    link_.wait_until_up(timeout, peer.empty() ? "the other host" : peer, gives_up);
    while (!active_) {
        {
            const std::lock_guard lock(failure_mutex_);
            if (!failure_.empty()) throw std::runtime_error(failure_);
        }
        if (gives_up() || std::chrono::steady_clock::now() >= deadline)
            throw std::runtime_error(
                fmt::format("link '{}': {} is running, but its AdaptorComp has not started", name_, peer));
        std::this_thread::sleep_for(1ms);
    }
}

void ReplayPeer::close() {
    if (recorded_.is_adaptor(side_) && active_.exchange(false) && link_.is_up())
        link_.call({"", control::deactivate, "", {}}, control::deactivation_timeout + 1s);
    link_.close();
}

// ---- main thread

bool ReplayPeer::send(const RecordedEvent& message) {
    return link_.writer(message.channel->port)
        .write_sized(message.bytes.size(), message.stamp, [&](std::span<std::byte> room) {
            std::copy(message.bytes.begin(), message.bytes.end(), room.begin());
            return true;
        });
}

Reply ReplayPeer::call(const RecordedEvent& request) {
    const RecordedChannel& channel = *request.channel;
    return link_.call({channel.port, channel.operation, channel.operation_signature, request.bytes},
                      call_timeout);
}

bool ReplayPeer::poll() {
    bool any = false;
    for (const std::string& port : received_ports_) {
        const auto receive = [&](const shm::Record& record) {
            any = true;
            if (check_ != nullptr) check_->receive(topic_of(port), record.stamp_ns, record.bytes);
        };
        while (link_.reader(port).read(false, receive)) {
        }
    }
    return any;
}

bool ReplayPeer::all_taken() const {
    const auto observation = shm::observe(name_);
    if (!observation || !link_.is_up()) return true; // no reader is left
    return std::all_of(observation->rings.begin(), observation->rings.end(), [this](const auto& ring) {
        return ring.writer != side_ || !ring.damage.empty() || ring.counters.waiting() == 0;
    });
}

// ---- threads of the link

/// The peer must have the recorded ports with their types. Additional ports are allowed.
std::string ReplayPeer::check_peer_ports(link::PortTable& peer) {
    for (const auto& port : recorded_.table(shm::other(side_)).ports) {
        const auto* const now = peer.find(port.name);
        if (now == nullptr)
            return fmt::format("link '{}': recorded port '{}' of {} no longer exists", name_, port.name,
                               port.component);
        if (now->kind != port.kind || now->signature != port.signature || now->operations != port.operations)
            return fmt::format(
                "link '{}': port '{}' of {} was recorded with type {}, but now has type {}; record again",
                name_, port.name, port.component, type_of(port), type_of(*now));
    }
    return "";
}

/// Replaces AdaptorComp, which activates the peer when its host starts.
void ReplayPeer::peer_connected() {
    if (!recorded_.is_adaptor(side_)) return; // AdaptorComp activates
    const std::string error = activate_peer();
    if (error.empty()) {
        active_ = true;
        return;
    }
    const std::lock_guard lock(failure_mutex_);
    failure_ = fmt::format("link '{}': {}", name_, error);
}

std::string ReplayPeer::activate_peer() {
    const shm::Side peer = shm::other(side_);
    for (const auto& port : recorded_.table(peer).ports) {
        if (port.kind != PortKind::service_required) continue;
        const auto operations = answers_.operations(recorded_.name, port.name, peer);
        if (operations.empty()) continue; // it was not called
        const auto binding = control::encode(control::ServiceBinding{port.name, operations});
        if (const auto reply = link_.call({"", control::bind, "", binding}, call_timeout);
            reply.status != CallStatus::ok)
            return fmt::format("service '{}': {}: {}", port.name, shm::name_of(reply.status), reply.text());
    }
    const auto reply = link_.call({"", control::activate, "", {}}, control::activation_timeout + 1s);
    if (reply.status == CallStatus::ok) return "";
    return fmt::format("cannot activate {}: {} {}", recorded_.table(peer).component_names(),
                       shm::name_of(reply.status), reply.text());
}

Reply ReplayPeer::execute_command(const link::Request& request) {
    if (request.operation == control::listen) {
        link_.serve_listen(request.arguments);
        return {};
    }
    if (request.operation == control::failed) {
        log::error("link '{}': {}", name_, control::decode_string(request.arguments));
        return {};
    }
    if (request.operation == control::deactivate) active_ = false;
    if (request.operation == control::activate) active_ = true;
    if (!recorded_.is_adaptor(side_) || request.arguments.empty()) return {};
    // A shared OPRoS component reports to its RTC that it has followed the request.
    const auto state = request.operation == control::activate ? control::ComponentState::active
                                                              : control::ComponentState::inactive;
    return {CallStatus::ok,
            control::encode(control::StateReport{control::decode_string(request.arguments), state, 0})};
}

Reply ReplayPeer::serve(const link::Request& request) {
    if (request.port.empty()) return execute_command(request);
    if (check_ != nullptr)
        check_->receive(topic_of(std::string(request.port)) + "/" + std::string(request.operation) +
                            "/request",
                        0, request.arguments);
    Reply reply = answers_.answer(recorded_.name, request);
    if (reply.status == CallStatus::not_ready) log::warn("link '{}': {}", name_, reply.text());
    return reply;
}

} // namespace tandem::command
