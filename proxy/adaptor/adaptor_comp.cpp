// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/adaptor_comp.hpp"

#include "proxy/adaptor/service/call_failure.hpp"
#include "proxy/link/protocol/control.hpp"
#include "proxy/link/wait_mode.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <ctime>
#include <thread>

namespace tandem::adaptor {
namespace control = link::control;
using link::CallStatus;
using link::PortKind;
using link::Reply;
using namespace std::chrono_literals;

namespace {

// After a reconnection: the RTC's host may still be starting when the link is up already.
constexpr int activation_attempts = 3;
constexpr const char* peer_name = "InterceptorComp of the RTM host";

/// Whether a call has failed because the peer's process or its component ends.
bool peer_has_gone(CallStatus status) {
    return status == CallStatus::peer_died || status == CallStatus::shut_down ||
           status == CallStatus::not_ready;
}

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
}

/// A host that is to end meanwhile does not wait to the end. Throws LinkError.
void AdaptorComp::wait_for_peer(std::chrono::milliseconds timeout) {
    link_->wait_until_up(timeout, peer_name, [this] { return directory_ && directory_->isEnding(); });
}

ReturnType AdaptorComp::onStart() {
    if (const std::string refused = first_refusal(); settings_.strict && !refused.empty()) {
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

/// Why the first connection that was refused was refused; empty if there is none.
std::string AdaptorComp::first_refusal() const {
    for (const auto& port : inputs_)
        if (!port->refusals().empty()) return port->refusals().front();
    for (const auto& port : outputs_)
        if (!port->refusals().empty()) return port->refusals().front();
    return "";
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
    for (const auto& name : settings_.event_ports)
        if (const auto* port = peer_ports_.find(name); !port || !link::is_data_port(port->kind))
            spdlog::error("{}: property 'event_ports' names '{}', which is no data port of {}", getId(), name,
                          peer_ports_.component_names());
    for (const auto& port : peer_ports_.ports) create_mirror_port(port);
    mirrors_created_ = true;
    if (link_->is_up())
        spdlog::info("{}: link '{}' is up, {} ports of {} mirrored", getId(), settings_.link,
                     peer_ports_.ports.size(), peer_ports_.component_names());
}

link::PortPolicy AdaptorComp::policy_of(const std::string& port) const {
    return link::read_port_policy("property", port, [this](const std::string& name) {
        const auto at = settings_.policies.find(name);
        return at == settings_.policies.end() ? std::string() : at->second;
    });
}

void AdaptorComp::create_mirror_port(const link::Port& port) {
    if (port.has_ring()) {
        auto policy = policy_of(port.name);
        add_queue_policy(port.queue, policy);
        if (port.kind == PortKind::data_in)
            link_->writer(port.name).set_policy(policy);
        else
            link_->reader(port.name).set_policy(policy);
    }
    if (port.is_event_in_port()) {
        fsm_ports_.push_back(std::make_unique<MirrorFsmPort>(port, link_->writer(port.name)));
        addPort(port.name, fsm_ports_.back().get());
        return;
    }
    const auto& events = settings_.event_ports;
    if (link::is_data_port(port.kind) && std::find(events.begin(), events.end(), port.name) != events.end())
        return create_event_mirror(port);
    switch (port.kind) {
    case PortKind::data_in:
        inputs_.push_back(
            std::make_unique<MirrorInPort>(port, link_->writer(port.name), settings_.conversion(port.name)));
        addPort(port.name, inputs_.back().get());
        break;
    case PortKind::data_out: {
        const auto set_listener = [this, name = port.name](DataPortListener* listener) {
            listen_to(name, listener);
        };
        outputs_.push_back(std::make_unique<MirrorOutPort>(port, link_->reader(port.name), set_listener,
                                                           settings_.conversion(port.name)));
        addPort(port.name, outputs_.back().get());
        break;
    }
    case PortKind::service_provided:
        addPort(port.name, new MirrorProvidedPort(port, *link_, settings_.call_timeout));
        break;
    case PortKind::service_required:
        required_.push_back(new MirrorRequiredPort(port));
        addPort(port.name, required_.back());
        break;
    }
}

void AdaptorComp::create_event_mirror(const link::Port& port) {
    if (port.kind == PortKind::data_in) {
        event_inputs_.push_back(std::make_unique<MirrorEventInPort>(port, link_->writer(port.name)));
        addPort(port.name, event_inputs_.back().get());
        return;
    }
    const auto set_listener = [this, name = port.name](DataPortListener* listener) {
        listen_to(name, listener);
    };
    event_outputs_.push_back(
        std::make_unique<MirrorEventOutPort>(port, link_->reader(port.name), set_listener));
    addPort(port.name, event_outputs_.back().get());
}

/// Before the mirrors are created, any table is accepted; of two ports of one name the first counts. Afterwards the
/// ports are connected: of a peer that came back those are used that it has with the same type as before.
std::string AdaptorComp::check_peer_ports(link::PortTable& peer) {
    const std::lock_guard lock(mutex_);
    if (!mirrors_created_) {
        const std::string error = remove_doubles(peer, own_ports_, settings_.link);
        if (!error.empty() && settings_.strict) return error;
        if (!error.empty()) spdlog::error("{}; it is left out, the others work", error);
        peer_ports_ = peer;
        return "";
    }
    for (const auto& port : peer_ports_.ports) {
        const auto* found = peer.find(port.name);
        if (found && *found == port) continue;
        const auto error =
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
        lock.lock(); // afterwards required_ does not change
    for (auto* port : required_)
        if (port->port() == name) return port;
    return nullptr;
}

// ---- commands to the peer

/// An activation waits for the execution contexts of two components, and for a call that the RTC may make
/// from its onActivated: so it gets the time of several calls. A transition waits for a callback of the RTC, which
/// the peer limits itself; it has a second more for its answer.
std::chrono::milliseconds AdaptorComp::timeout_of(std::string_view command) const {
    const auto rtcs =
        static_cast<int>(std::max<std::size_t>(peer_ports_.components.size(), 1)); // one after the other
    if (command == control::activate)
        return rtcs * std::max(4 * settings_.call_timeout, control::activation_timeout + 1s);
    if (command == control::deactivate || command == control::reset)
        return rtcs * std::max(settings_.call_timeout, control::deactivation_timeout + 1s);
    return settings_.call_timeout;
}

Reply AdaptorComp::send_command(std::string_view command, std::span<const std::byte> arguments) {
    return link_->call({"", command, "", arguments}, timeout_of(command));
}

/// Tells the peer which operations are provided here for the services that the RTC requires. Returns the failure if
/// the peer could not be told. A service that the peer refuses is left out, unless the user is strict.
Reply AdaptorComp::publish_bindings() {
    for (const auto* port : required_) {
        const auto reply = send_command(
            control::bind, control::encode(control::ServiceBinding{port->port(), port->operations()}));
        if (reply.status == CallStatus::ok) continue;
        if (settings_.strict || reply.status != CallStatus::exception) return reply;
        spdlog::error("{}: {}; this service is left out, the others work", getId(),
                      describe_failure(reply, settings_.call_timeout));
    }
    return {};
}

/// Executes a life-cycle command on the RTC; logs one line if that fails, unless the peer has gone, of which the link tells.
CallStatus AdaptorComp::drive_rtc(std::string_view command) {
    // The RTC may call a service from its onActivated on, so the operations must be known before.
    Reply reply = command == control::activate ? publish_bindings() : Reply{};
    const bool bound = reply.status == CallStatus::ok;
    if (bound) reply = send_command(command);
    if (reply.status != CallStatus::ok && (command == control::reset || !peer_has_gone(reply.status)))
        spdlog::error("{}: link '{}': cannot {} {}: {}", getId(), settings_.link, command,
                      peer_ports_.component_names(),
                      describe_failure(reply, bound ? timeout_of(command) : settings_.call_timeout));
    return reply.status;
}

/// Called by a MirrorOutPort under the lock of the input port that is connected with it: does not wait.
void AdaptorComp::listen_to(const std::string& port, DataPortListener* listener) {
    if (listener)
        link_->set_arrival_listener(port, [listener] { listener->arrived(); });
    else
        link_->set_arrival_listener(port, {});
    {
        const std::lock_guard lock(listened_ports_mutex_);
        if (listener)
            listened_ports_.insert(port);
        else
            listened_ports_.erase(port);
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
    if (!link_->is_up()) return; // peer_connected() comes here again
    const auto reply = link_->request_rings(ports, settings_.call_timeout);
    if (reply.status != CallStatus::ok && !peer_has_gone(reply.status) && link_->is_up())
        spdlog::warn("{}: link '{}': event-driven components notice arrivals up to 1 s late: {}", getId(),
                     settings_.link, describe_failure(reply, settings_.call_timeout));
}

void AdaptorComp::publish_link_state() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    const std::lock_guard lock(link_state_mutex_);
    // Asked under the lock, so that of two threads the one with the newer state sends last.
    const bool up = link_->is_up();
    const double stamp = static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    link_state_.push(std::vector<double>{stamp, static_cast<double>(++link_state_sequence_), up ? 1.0 : 0.0});
}

} // namespace tandem::adaptor
