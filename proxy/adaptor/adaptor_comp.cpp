// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/adaptor_comp.hpp"

#include "proxy/link/protocol/control.hpp"
#include "proxy/link/wait_mode.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <thread>

namespace tandem::adaptor {
namespace control = link::control;
using link::CallStatus;
using link::peer_has_gone;
using link::Reply;
using namespace std::chrono_literals;

namespace {

// After a reconnection: the RTC's host may still be starting when the link is up already.
constexpr int activation_attempts = 3;
constexpr const char* peer_name = "InterceptorComp of the RTM host";

/// Removes the ports of the peer whose mirrors would have the name of another port. Returns a line about the last of
/// them; empty if there is none.
std::string remove_doubles(link::PortTable& peer, const link::PortTable& own, const std::string& link) {
    std::set<std::string> names{"linkState", "missedDeadline"};
    for (const auto& port : own.ports) names.insert(port.name);
    std::string error;
    std::erase_if(peer.ports, [&](const link::Port& port) {
        if (names.insert(port.name).second) return false;
        error = fmt::format("link '{}': the peer shares a port '{}', which is there already; rename it", link,
                            port.name);
        return true;
    });
    return error;
}

} // namespace

AdaptorComp::AdaptorComp() : Component("AdaptorComp") {
    addPort("linkState", &link_state_);
    addPort("missedDeadline", &missed_deadline_);
}

AdaptorComp::~AdaptorComp() { close_link(); }

/// Before any member goes, since the link's threads use them; before the shared components, whose ports it uses.
void AdaptorComp::close_link() {
    if (link_) link_->close();
    if (shared_) shared_->disconnect();
}

// ---- life cycle, in the host's threads

ReturnType AdaptorComp::onInitialize() {
    if (link_) return OPROS_SUCCESS; // reset() comes here again; the link and the mirrors stay as they are
    try {
        settings_ = read_settings(getPropertyMap());
        create_link();
        if (!settings_.port_table.empty()) {
            auto table = link::decode_port_table_text(settings_.port_table);
            const std::string error = check_peer_ports(table);
            if (!error.empty()) throw link::LinkError(error);
            create_mirror_ports();
            return OPROS_SUCCESS;
        }
        shared_->connect(*link_, [this](const std::string& port, DataPortListener* listener) {
            listen_to(port, listener);
        });
        link_->open();
        // The host connects ports as soon as this function returns, so the peer's table must be here by then.
        wait_for_peer(settings_.wait);
        create_mirror_ports();
        return OPROS_SUCCESS;
    } catch (const std::runtime_error& error) {
        spdlog::error("{}: {}", getId(), error.what());
        close_link();
        shared_.reset();
        link_.reset();
        return OPROS_INITIALIZE_API_ERROR;
    }
}

void AdaptorComp::create_link() {
    shared_ = std::make_unique<SharedComponents>(getId(), settings_.call_timeout);
    own_ports_ = shared_->find(settings_.share, settings_.interfaces, directory_);
    link::LinkOptions options;
    options.name = settings_.link;
    options.rings.large_bytes = settings_.large_bytes;
    options.segment_bytes = settings_.segment_bytes;
    options.group = settings_.group;
    options.wait = link::wait_options_from_environment();
    link_ =
        std::make_unique<link::Link>(shm::Side::first, options, own_ports_, static_cast<LinkHandler&>(*this));
    mirrors_ = std::make_unique<MirrorPorts>(
        settings_, *link_,
        [this](const std::string& port, DataPortListener* listener) { listen_to(port, listener); });
}

/// A host that is to end meanwhile does not wait to the end. Throws LinkError.
void AdaptorComp::wait_for_peer(std::chrono::milliseconds timeout) {
    link_->wait_until_up(timeout, peer_name, [this] { return directory_ && directory_->isEnding(); });
}

ReturnType AdaptorComp::onStart() {
    if (const std::string refused = mirrors_->first_refusal(); settings_.strict && !refused.empty()) {
        spdlog::error("{}: strict: {}", getId(), refused);
        return OPROS_CALL_API_ERROR;
    }
    rtc_failed_ = false;
    bool activated = false;
    try {
        activated = activate_rtc() == CallStatus::ok;
    } catch (const link::LinkError& error) {
        spdlog::error("{}: {}", getId(), error.what());
    }
    // The RTC may have gone to ERROR between its activation and this line; the report came to serve().
    started_ = activated && !rtc_failed_;
    publish_link_state();
    return started_ ? OPROS_SUCCESS : OPROS_CALL_API_ERROR;
}

/// Activates the RTC of whichever peer is there: one that goes meanwhile is waited for as one that has not come. Throws
/// LinkError if none comes.
CallStatus AdaptorComp::activate_rtc() {
    const auto deadline = std::chrono::steady_clock::now() + settings_.wait;
    for (;;) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
            deadline - std::chrono::steady_clock::now());
        wait_for_peer(std::max(left, 0ms));
        const auto status = drive_rtc(control::activate);
        if (!peer_has_gone(status) || left <= 0ms) return status;
        std::this_thread::sleep_for(1ms); // until the link knows, too
    }
}

ReturnType AdaptorComp::onStop() {
    started_ = false;
    // A peer that has gone, or goes meanwhile because both hosts are ended at once, has nothing left to deactivate.
    const auto status = link_->is_up() ? drive_rtc(control::deactivate) : CallStatus::ok;
    return status == CallStatus::ok || peer_has_gone(status) ? OPROS_SUCCESS : OPROS_CALL_API_ERROR;
}

ReturnType AdaptorComp::onReset() { return onRecover(); }
ReturnType AdaptorComp::onRecover() {
    return drive_rtc(control::reset) == CallStatus::ok ? OPROS_SUCCESS : OPROS_CALL_API_ERROR;
}

ReturnType AdaptorComp::onError() {
    started_ = false;
    return OPROS_SUCCESS;
}

ReturnType AdaptorComp::onDestroy() {
    close_link();
    return OPROS_SUCCESS;
}

// ---- ports

void AdaptorComp::create_mirror_ports() {
    const std::lock_guard lock(mutex_);
    mirrors_->create(peer_ports_, *this);
    mirrors_created_ = true;
    if (link_->is_up())
        spdlog::info("{}: link '{}' is up, {} ports of {} mirrored", getId(), settings_.link,
                     peer_ports_.ports.size(), peer_ports_.component_names());
}

/// Before the mirrors are created, any table is accepted; of two ports of one name the first counts. Afterwards the
/// ports are connected: of a peer that came back those are used that it has with the same type as before.
std::string AdaptorComp::check_peer_ports(link::PortTable& peer) {
    const std::lock_guard lock(mutex_);
    if (!mirrors_created_) {
        std::string error = remove_doubles(peer, own_ports_, settings_.link);
        if (!error.empty() && settings_.strict) return error;
        if (!error.empty()) spdlog::error("{}; it is left out, the others work", error);
        peer_ports_ = peer;
        return "";
    }
    for (const auto& port : peer_ports_.ports) {
        const auto* found = peer.find(port.name);
        if (found && *found == port) continue;
        auto error =
            fmt::format("link '{}': port '{}' of the peer that came back {}; start this host again to use it",
                        settings_.link, port.name, found ? "has another type than before" : "is gone");
        if (settings_.strict) return error;
        spdlog::error("{}; it is left out, the others work", error);
    }
    std::erase_if(peer.ports, [this](const link::Port& port) {
        const auto* known = peer_ports_.find(port.name);
        return !known || *known != port;
    });
    return "";
}

// ---- the peer connects, disconnects, calls

void AdaptorComp::link_state_changed(bool) { publish_link_state(); }

/// The receivers' own threads handle the event.
void AdaptorComp::deadline_missed(const std::string& port) {
    EventData<std::string> event;
    event.setId("missedDeadline");
    event.setContentData(port);
    missed_deadline_.push(&event);
}

void AdaptorComp::peer_connected() {
    publish_listened_ports();
    shared_->peer_connected();
    if (!started_) return;
    spdlog::info("{}: link '{}' is up again", getId(), settings_.link);
    for (int attempt = 0; attempt < activation_attempts && started_ && link_->is_up(); ++attempt) {
        const auto status = drive_rtc(control::activate);
        // A peer that has gone again is no failure, even while the link does not know yet: the next one gets the same
        // attempts.
        if (status == CallStatus::ok || peer_has_gone(status)) return;
    }
    if (link_->is_up() && started_.exchange(false)) stopOnError();
}

void AdaptorComp::peer_disconnected() { shared_->peer_lost(); }

Reply AdaptorComp::execute_command(const link::Request& request) {
    if (request.operation != control::failed) return shared_->serve(request);
    spdlog::error("{}: {}", getId(), control::decode_string(request.arguments));
    rtc_failed_ = true;
    if (started_.exchange(false)) stopOnError();
    return {};
}

[[gnu::hot]] Reply AdaptorComp::serve(const link::Request& request) {
    if (request.port.empty()) return execute_command(request);
    if (auto* port = find_required_port(request.port)) return port->serve(request);
    if (auto* port = shared_->find_service(request.port)) return port->serve(request);
    return Reply::failure(CallStatus::no_such_operation, "no such service port");
}

/// nullptr also while the mirrors are not created yet: the peer may call as soon as the link is up.
[[gnu::hot]] MirrorRequiredPort* AdaptorComp::find_required_port(std::string_view name) {
    std::unique_lock lock(mutex_, std::defer_lock);
    if (!mirrors_created_.load(std::memory_order_acquire))
        lock.lock(); // afterwards the mirrors do not change
    return mirrors_->find_required(name);
}

} // namespace tandem::adaptor
