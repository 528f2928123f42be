// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/adaptor_comp.hpp"

#include "host/log/log.hpp"
#include "host/process/published/notices.hpp"
#include "proxy/adaptor/model.hpp"
#include "proxy/adaptor/property_check.hpp"
#include "proxy/link/protocol/control.hpp"
#include "proxy/link/wait_mode.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

namespace tandem::adaptor {
namespace control = link::control;
using link::CallStatus;
using link::peer_has_gone;
using link::Reply;
using namespace std::chrono_literals;

namespace {

// After a reconnection, the RTC's host may still be starting when the link is already up.
constexpr int activation_attempts = 3;
constexpr const char* peer_name = "InterceptorComp of the RTM host";

/// Removes the ports of the peer whose mirrors would have the name of another port. Returns a line about the last of them;
/// empty if there is none.
std::string remove_doubles(link::PortTable& peer, const link::PortTable& own, const std::string& link) {
    std::set<std::string> names{"linkState", "missedDeadline"};
    for (const auto& port : own.ports) names.insert(port.name);
    std::string error;
    std::erase_if(peer.ports, [&](const link::Port& port) {
        if (names.insert(port.name).second) return false;
        error =
            fmt::format("link '{}': the peer shares a port '{}', but this name is already in use; rename it",
                        link, port.name);
        return true;
    });
    return error;
}

} // namespace

AdaptorComp::AdaptorComp() : Component("AdaptorComp") {
    addPort("linkState", &link_state_);
    addPort("missedDeadline", &missed_deadline_);
}

AdaptorComp::~AdaptorComp() {
    close_link();
    if (restarts_) restarts_->stop(); // last: its task may wait until the link is closed
}

/// Called before any member is destroyed, because the link's threads use the members; in particular before the shared
/// components, whose ports the link uses.
void AdaptorComp::close_link() {
    if (link_) link_->close();
    if (shared_) shared_->disconnect();
}

// ---- life cycle, in the host's threads

ReturnType AdaptorComp::onInitialize() {
    if (link_) return OPROS_SUCCESS; // reset() calls this again; the link and the mirrors stay
    try {
        settings_ = read_settings(getPropertyMap());
        report_unknown_properties();
        create_link();
        if (!settings_.port_table.empty()) {
            auto table = link::decode_port_table_text(settings_.port_table);
            const std::string error = check_peer_ports(table);
            if (!error.empty()) throw link::LinkError(error);
            create_mirror_ports();
            return OPROS_SUCCESS;
        }
        shared_->connect(
            *link_,
            [this](const link::Port& port, engine::ArrivalListener* listener) { listen_to(port, listener); },
            [this] { link_->post([this] { follow_shared_ports(); }); });
        link_->open();
        // The host connects ports as soon as this function returns, so the peer's table must be here by then.
        wait_for_peer(settings_.wait);
        create_mirror_ports();
        return OPROS_SUCCESS;
    } catch (const std::runtime_error& error) {
        log::error("{}: {}", getId(), error.what());
        close_link();
        shared_.reset();
        listeners_.reset();
        link_.reset();
        return OPROS_INITIALIZE_API_ERROR;
    }
}

/// A misspelt property would have no effect, and nobody would notice.
void AdaptorComp::report_unknown_properties() {
    std::vector<std::string> names;
    for (const auto& [name, value] : getPropertyMap()) names.push_back(name);
    report_useless(find_unknown_properties(names));
}

/// Takes a line for each setting without effect. Throws std::runtime_error with the first one if `strict` is set.
void AdaptorComp::report_useless(const std::vector<std::string>& lines) {
    if (settings_.strict && !lines.empty()) throw std::runtime_error(lines.front());
    for (const auto& line : lines) {
        log::error("{}: {}", getId(), line);
        process::publish_notice(process::NoticeKind::setting, getId() + ": " + line);
    }
}

void AdaptorComp::create_link() {
    shared_ = std::make_unique<engine::SharedComponents>(getId(), settings_.call_timeout);
    std::vector<std::string> useless;
    own_ports_ = shared_->find(settings_.share, settings_.interfaces, directory(), useless);
    report_useless(useless);
    own_ports_.model = model;
    link::LinkOptions options;
    options.name = settings_.link;
    options.rings.large_bytes = settings_.large_bytes;
    options.segment_bytes = settings_.segment_bytes;
    options.group = settings_.group;
    options.wait = link::wait_options_from_environment();
    link_ =
        std::make_unique<link::Link>(shm::Side::first, options, own_ports_, static_cast<LinkHandler&>(*this));
    restarts_ = std::make_unique<link::TaskQueue>(settings_.link, 1);
    listeners_ = std::make_unique<ArrivalListeners>(*link_);
    mirrors_ = std::make_unique<MirrorPorts>(
        settings_, *link_,
        [this](const link::Port& port, engine::ArrivalListener* listener) { listen_to(port, listener); },
        [this] { link_->post([this] { publish_late_bindings(); }); });
}

/// Ends early if the host is shutting down. Throws LinkError.
void AdaptorComp::wait_for_peer(std::chrono::milliseconds timeout) {
    link_->wait_until_up(timeout, peer_name, [this] { return is_ending(); });
}

ReturnType AdaptorComp::onStart() {
    std::string refused;
    if (settings_.strict) {
        const std::lock_guard lock(mutex_);
        refused = mirrors_->first_refusal();
    }
    if (!refused.empty()) {
        log::error("{}: strict: {}", getId(), refused);
        return OPROS_CALL_API_ERROR;
    }
    if (!run_state_.begin_start(is_restarting())) return OPROS_CALL_API_ERROR;
    try {
        activate_rtc();
    } catch (const link::LinkError& error) {
        log::error("{}: {}", getId(), error.what());
    }
    publish_link_state();
    return run_state_.end_start() ? OPROS_SUCCESS : OPROS_CALL_API_ERROR;
}

/// Activates the RTC of the current peer. If that peer goes meanwhile, waits for another one. Throws LinkError if none
/// comes.
void AdaptorComp::activate_rtc() {
    const auto deadline = std::chrono::steady_clock::now() + settings_.wait;
    for (;;) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
            deadline - std::chrono::steady_clock::now());
        wait_for_peer(std::max(left, 0ms));
        {
            const std::lock_guard lock(life_cycle_mutex_);
            const auto status = activate_on_connection();
            // The RTC may have gone to ERROR between its activation and this line; serve() received the report.
            if (status == CallStatus::ok) run_state_.activated();
            if (!peer_has_gone(status) || left <= 0ms) return;
        }
        std::this_thread::sleep_for(1ms); // until the link has noticed this as well
    }
}

/// With life_cycle_mutex_ held.
CallStatus AdaptorComp::activate_on_connection() {
    const auto connection = link_->connections(); // read first: a later connection needs a new activation
    const auto status = drive_rtc(control::activate);
    if (status == CallStatus::ok) activated_connection_ = connection;
    return status;
}

/// Does nothing in a restart after which the user has stopped, recovered or started this object.
ReturnType AdaptorComp::start() {
    if (is_restarting() && !run_state_.is_restart_wanted()) return OPROS_SUCCESS;
    return Component::start();
}

/// Also withdraws a restart, which may be due in ERROR. The other RTCs may still be active then.
ReturnType AdaptorComp::stop() {
    const bool withdrawn = run_state_.withdraw_restart();
    const ReturnType result = Component::stop();
    if (result == OPROS_SUCCESS || !withdrawn) return result;
    log::info("{0}: link '{1}': {0} no longer starts by itself; use tandem opros recover {0} and start {0}",
              getId(), settings_.link);
    return onStop();
}

ReturnType AdaptorComp::onStop() {
    run_state_.let_user_decide(); // before the lock, so that a new peer is not activated any more
    const std::lock_guard lock(life_cycle_mutex_);
    // A peer that has gone, or goes meanwhile because both hosts end at once, has nothing left to deactivate.
    const auto status = link_->is_up() ? drive_rtc(control::deactivate) : CallStatus::ok;
    return status == CallStatus::ok || peer_has_gone(status) ? OPROS_SUCCESS : OPROS_CALL_API_ERROR;
}

ReturnType AdaptorComp::onReset() { return onRecover(); }
/// Resets no RTC when this object recovers by itself: whether an error of an RTC may be ignored is the user's decision.
ReturnType AdaptorComp::onRecover() {
    if (is_restarting()) return OPROS_SUCCESS;
    const std::lock_guard lock(life_cycle_mutex_);
    if (drive_rtc(control::reset) != CallStatus::ok) return OPROS_CALL_API_ERROR;
    run_state_.let_user_decide();
    return OPROS_SUCCESS;
}

ReturnType AdaptorComp::onError() {
    run_state_.enter_error();
    return OPROS_SUCCESS;
}

ReturnType AdaptorComp::onDestroy() {
    close_link();
    return OPROS_SUCCESS;
}

// ---- ports

/// Throws std::runtime_error if a property has no effect and `strict` is set.
void AdaptorComp::create_mirror_ports() {
    const std::lock_guard lock(mutex_);
    report_useless(mirrors_->find_useless_properties(peer_ports_));
    mirrors_->update(peer_ports_, *this);
    mirrors_created_ = true;
    if (link_->is_up())
        log::info("{}: link '{}' is up, {} ports of {} mirrored", getId(), settings_.link,
                  peer_ports_.ports.size(), peer_ports_.component_names());
}

/// Updates the mirrors after peer_connected() and peer_ports_changed(). [task-thread]
void AdaptorComp::update_mirror_ports() {
    const std::lock_guard lock(mutex_);
    if (mirrors_created_) mirrors_->update(peer_ports_, *this);
}

link::PortTable AdaptorComp::peer_ports() {
    const std::lock_guard lock(mutex_);
    return peer_ports_;
}

/// If two ports have the same name, the first one counts. With `strict`, also refuses a peer that returns without a port that
/// was mirrored, or with a different port of that name.
std::string AdaptorComp::check_peer_ports(link::PortTable& peer) {
    const std::lock_guard lock(mutex_);
    std::string error = remove_doubles(peer, own_ports_, settings_.link);
    if (settings_.strict && mirrors_created_ && error.empty() && !link_->is_up())
        for (const auto& port : peer_ports_.ports)
            if (const auto* now = peer.find(port.name); !now || !now->is_same(port))
                error = fmt::format("link '{}': port '{}' of the peer that came back {}", settings_.link,
                                    port.name, now ? "has another type than before" : "is gone");
    if (settings_.strict && !error.empty()) return error;
    if (!error.empty()) log::error("{}; it is left out, and the others work", error);
    peer_ports_ = peer;
    return "";
}

/// Called when a shared component has added or removed a port. [task-thread]
void AdaptorComp::follow_shared_ports() {
    auto table = shared_->follow_ports();
    if (!table) return;
    table->model = model;
    {
        const std::lock_guard lock(mutex_);
        own_ports_ = *table;
    }
    link_->set_ports(std::move(*table));
}

// ---- the peer connects, disconnects, calls

void AdaptorComp::link_state_changed(bool) { publish_link_state(); }

/// The receivers handle the event in their own threads.
void AdaptorComp::deadline_missed(const std::string& port) {
    EventData<std::string> event;
    event.setId("missedDeadline");
    event.setContentData(port);
    missed_deadline_.push(&event);
}

void AdaptorComp::peer_ports_changed() { update_mirror_ports(); }

void AdaptorComp::peer_connected() {
    update_mirror_ports();
    publish_listened_ports();
    shared_->peer_connected();
    if (run_state_.is_running()) return activate_for_new_peer();
    // This report may come late, after onStart() has activated the RTCs on this connection and one of them has failed.
    // Only the RTC can end that error.
    if (was_activated_on_connection()) return;
    report_inactive();
    request_restart();
}

/// Returns whether the RTCs have been activated on this connection, even if they were deactivated since.
bool AdaptorComp::was_activated_on_connection() {
    const std::lock_guard lock(life_cycle_mutex_);
    return activated_connection_ == link_->connections();
}

void AdaptorComp::activate_for_new_peer() {
    for (int attempt = 0; attempt < activation_attempts; ++attempt) {
        const std::lock_guard lock(life_cycle_mutex_);
        if (!run_state_.is_running() || !link_->is_up()) break;
        // onStart() has already activated the RTC on this connection.
        if (activated_connection_ == link_->connections()) return;
        if (attempt == 0) log::info("{}: link '{}' is up again", getId(), settings_.link);
        const auto status = activate_on_connection();
        // A peer that has left again is not a failure, even if the link has not noticed yet: the next peer gets the same
        // attempts.
        if (status == CallStatus::ok || peer_has_gone(status)) return;
    }
    if (link_->is_up() && run_state_.fail()) stopOnError();
}

/// Says why the RTCs of a peer that has come back stay inactive.
void AdaptorComp::report_inactive() {
    {
        const std::lock_guard lock(life_cycle_mutex_);
        if (activated_connection_ == 0) return;
    }
    if (run_state_.is_restart_wanted()) return;
    log::warn("{0}: link '{1}' is up again; {2} stays inactive, because {0} is not ACTIVE: use tandem opros "
              "start {0}, "
              "and tandem opros recover {0} before if it is in ERROR",
              getId(), settings_.link, peer_ports().component_names());
}

/// In a separate thread, because the threads of the link must not wait for a transition, which may close the link.
/// [any-thread]
void AdaptorComp::request_restart() {
    if (!run_state_.is_restart_wanted()) return;
    restarts_->start();
    // A task that is already waiting does the same. The peer may ask any number of times.
    restarts_->post_in_turn(std::chrono::nanoseconds::zero(), 0, [this] { restart_after_error(); });
}

void AdaptorComp::restart_after_error() {
    if (!run_state_.is_restart_wanted() || !link_->is_up()) return;
    log::info("{}: link '{}': {} can be active again; {} leaves ERROR", getId(), settings_.link,
              peer_ports().component_names(), getId());
    restarting_thread_ = std::this_thread::get_id();
    const std::string error = restart(*this);
    restarting_thread_ = std::thread::id();
    if (!error.empty()) log::error("{} stays in ERROR: {}", getId(), error);
}

void AdaptorComp::peer_disconnected() { shared_->peer_lost(); }

Reply AdaptorComp::execute_command(const link::Request& request) {
    if (request.operation == control::recovered) {
        request_restart();
        return {};
    }
    if (request.operation != control::failed) return shared_->serve(request);
    log::error("{}: {}", getId(), control::decode_string(request.arguments));
    // The restart is wanted before this object is in ERROR: the RTCs may be active again at once.
    if (run_state_.fail()) stopOnError();
    return {};
}

std::optional<link::ReplyView> AdaptorComp::serve_known(const link::KnownRequest& request,
                                                        wire::MessageBuffer& memory) {
    if (auto* port = mirrors_->find_required(request.id.port)) return port->serve_known(request, memory);
    return std::nullopt;
}

Reply AdaptorComp::serve(const link::Request& request) {
    if (request.port.empty()) return execute_command(request);
    if (auto* port = mirrors_->find_required(request.port)) return port->serve(request);
    if (auto* port = shared_->find_service(request.port)) return port->serve(request);
    // The link is up shortly before the ports of the peer are mirrored here.
    return Reply::failure(CallStatus::not_ready,
                          fmt::format("not ready: service port '{}' is not mirrored", request.port));
}

} // namespace tandem::adaptor
