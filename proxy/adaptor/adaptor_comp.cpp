// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/adaptor_comp.hpp"

#include "proxy/adaptor/method_check.hpp"
#include "proxy/link/control.hpp"
#include "proxy/link/wait_mode.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <ctime>
#include <set>

namespace tandem::adaptor {
namespace control = link::control;
using link::CallStatus;
using link::PortKind;
using link::Reply;

namespace {

constexpr int activation_attempts = 3;

std::string check_names(const link::PortTable& peer, const std::string& link) {
    std::set<std::string> names{"linkState"};
    for (const auto& port : peer.ports)
        if (!names.insert(port.name).second)
            return fmt::format("link '{}': the peer shares a port '{}', which is there already; rename it",
                               link, port.name);
    return "";
}

} // namespace

AdaptorComp::AdaptorComp() : Component("AdaptorComp") { addPort("linkState", &link_state_); }

AdaptorComp::~AdaptorComp() {
    if (link_) link_->close();
}

// ---- life cycle, in the host's thread

ReturnType AdaptorComp::onInitialize() {
    if (link_) return OPROS_SUCCESS; // reset() comes here again; what stands connected keeps its link
    try {
        settings_ = read_settings(getPropertyMap());
        link::LinkOptions options;
        options.name = settings_.link;
        options.rings.large_bytes = settings_.large_bytes;
        options.segment_bytes = settings_.segment_bytes;
        options.wait = link::wait_options_from_environment();
        link_ = std::make_unique<link::Link>(shm::Side::first, options, link::PortTable{},
                                             static_cast<LinkHandler&>(*this));
        link_->open();
        link_->wait_until_up(settings_.wait, "InterceptorComp of the RTM host");
        create_mirror_ports();
        return OPROS_SUCCESS;
    } catch (const std::runtime_error& error) {
        spdlog::error("{}: {}", getId(), error.what());
        link_.reset();
        return OPROS_INITIALIZE_API_ERROR;
    }
}

ReturnType AdaptorComp::onStart() {
    try {
        link_->wait_until_up(settings_.wait, "InterceptorComp of the RTM host");
    } catch (const link::LinkError& error) {
        spdlog::error("{}: {}", getId(), error.what());
        return OPROS_CALL_API_ERROR;
    }
    rtc_failed_ = false;
    const auto code = drive(control::activate);
    started_ = code == OPROS_SUCCESS && !rtc_failed_;
    publish_link_state();
    return started_ || code != OPROS_SUCCESS ? code : OPROS_CALL_API_ERROR;
}

ReturnType AdaptorComp::onStop() {
    started_ = false;
    // A peer that has gone has nothing left to deactivate.
    return link_->is_up() ? drive(control::deactivate) : OPROS_SUCCESS;
}

ReturnType AdaptorComp::onReset() { return drive(control::reset); }
ReturnType AdaptorComp::onRecover() { return drive(control::reset); }

ReturnType AdaptorComp::onError() {
    started_ = false;
    return OPROS_SUCCESS;
}

ReturnType AdaptorComp::onDestroy() {
    if (link_) link_->close();
    return OPROS_SUCCESS;
}

// ---- ports

void AdaptorComp::create_mirror_ports() {
    const std::lock_guard lock(mutex_);
    for (const auto& port : table_.ports) create_mirror_port(port);
    mirror_ports_created_ = true;
    spdlog::info("{}: link '{}' is up, {} ports of {} mirrored", getId(), settings_.link, table_.ports.size(),
                 table_.component);
}

void AdaptorComp::create_mirror_port(const link::Port& port) {
    switch (port.kind) {
    case PortKind::data_in:
        inputs_.push_back(std::make_unique<MirrorInPort>(port, link_->writer(port.name)));
        addPort(port.name, inputs_.back().get());
        break;
    case PortKind::data_out:
        outputs_.push_back(std::make_unique<MirrorOutPort>(port, link_->reader(port.name)));
        addPort(port.name, outputs_.back().get());
        break;
    case PortKind::service_provided:
        addPort(port.name, new MirrorProvidedPort(port, *link_, settings_.call_timeout));
        break;
    case PortKind::service_required:
        required_.push_back(new MirrorRequiredPort(port));
        addPort(port.name, required_.back());
        break;
    }
}

/// A peer that came back must still have every port that stands connected here.
std::string AdaptorComp::check_peer_ports(const link::PortTable& peer) {
    const std::lock_guard lock(mutex_);
    if (!mirror_ports_created_) {
        table_ = peer;
        return check_names(peer, settings_.link);
    }
    for (const auto& port : table_.ports) {
        const auto* now = peer.find(port.name);
        if (now && *now == port) continue;
        return fmt::format("link '{}': port '{}' of the peer that came back {}; start this host again",
                           settings_.link, port.name, now ? "has another type than before" : "is gone");
    }
    return "";
}

// ---- the peer comes, goes, calls

void AdaptorComp::link_state_changed(bool) { publish_link_state(); }

void AdaptorComp::peer_connected() {
    if (!started_) return;
    spdlog::info("{}: link '{}' is up again", getId(), settings_.link);
    for (int attempt = 0; attempt < activation_attempts && started_ && link_->is_up(); ++attempt)
        if (drive(control::activate) == OPROS_SUCCESS) return;
    if (link_->is_up() && started_.exchange(false))
        stopOnError(); // while it is down, the next peer is waited for
}

void AdaptorComp::peer_disconnected() {}

Reply AdaptorComp::serve(const link::Request& request) {
    if (request.port.empty()) {
        if (request.operation != control::failed)
            return Reply::failure(CallStatus::no_such_operation, "unknown command");
        spdlog::error("{}: {}", getId(), control::decode_string(request.arguments));
        rtc_failed_ = true;
        if (started_.exchange(false)) stopOnError();
        return {};
    }
    if (auto* port = find_required_port(request.port)) return port->serve(request);
    return Reply::failure(CallStatus::no_such_operation, "no such service port");
}

/// The peer may call before this half has grown its ports.
MirrorRequiredPort* AdaptorComp::find_required_port(std::string_view name) {
    const std::lock_guard lock(mutex_);
    for (auto* port : required_)
        if (port->port() == name) return port;
    return nullptr;
}

// ---- driving the peer

/// An activation may wait for two execution contexts, and for a call that the RTC makes in it.
std::chrono::milliseconds AdaptorComp::timeout_of(std::string_view command) const {
    return command == control::activate ? 4 * settings_.call_timeout : settings_.call_timeout;
}

Reply AdaptorComp::control(std::string_view command, std::span<const std::byte> arguments) {
    return link_->call({"", command, "", arguments}, timeout_of(command));
}

std::string AdaptorComp::publish_bindings() {
    for (const auto* port : required_) {
        const auto reply = control(
            control::bind, control::encode(control::ServiceBinding{port->port(), port->operations()}));
        if (reply.status != CallStatus::ok) return describe(reply, settings_.call_timeout);
    }
    return "";
}

ReturnType AdaptorComp::drive(std::string_view command) {
    std::string error = command == control::activate ? publish_bindings() : "";
    if (error.empty()) {
        const auto reply = control(command);
        if (reply.status == CallStatus::ok) return OPROS_SUCCESS;
        error = describe(reply, timeout_of(command));
    }
    spdlog::error("{}: link '{}': cannot {} {}: {}", getId(), settings_.link, command, table_.component,
                  error);
    return OPROS_CALL_API_ERROR;
}

void AdaptorComp::publish_link_state() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    const std::lock_guard lock(link_state_mutex_);
    const bool up = link_->is_up(); // looked at here, so that an older answer cannot overtake a newer one
    const double stamp = static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    link_state_.push(std::vector<double>{stamp, static_cast<double>(++link_state_sequence_), up ? 1.0 : 0.0});
}

} // namespace tandem::adaptor
