// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/interceptor_comp.hpp"

#include "host/log/log.hpp"
#include "host/process/published/notices.hpp"
#include "proxy/interceptor/drive/rtc_driver.hpp"
#include "proxy/interceptor/engine/manager.hpp"
#include "proxy/interceptor/manage/rtc_connector.hpp"
#include "proxy/interceptor/manage/rtc_manager.hpp"
#include "proxy/interceptor/parameter_check.hpp"
#include "proxy/link/protocol/control.hpp"
#include "proxy/link/session/link_thread.hpp"
#include "proxy/link/wait_mode.hpp"

#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <stdexcept>
#include <utility>

namespace tandem::interceptor {
namespace control = link::control;
using link::CallStatus;
using link::Reply;

namespace {

// Each component that the other process shares takes memory and a name in this process.
constexpr std::size_t max_shown_components = 256;
// The end of the link ends the call that requested it, unless the reply has already been sent.
constexpr std::chrono::milliseconds time_for_reply{100};

/// Otherwise the ORB registers the worker again for each call, which takes as long as the call.
void make_worker_known_to_orb() { thread_local const omni_thread::ensure_self known_to_orb; }

} // namespace

InterceptorComp::InterceptorComp(RTC::Manager* manager)
    : RTC::DataFlowComponentBase(manager), link_state_out_("linkState", link_state_),
      missed_deadline_out_("missedDeadline", missed_deadline_) {}

InterceptorComp::~InterceptorComp() { disconnect_all(); }

// ---- set-up and end, in the manager's thread

RTC::ReturnCode_t InterceptorComp::onInitialize() {
    try {
        settings_ = read_settings(getProperties());
        addOutPort("linkState", link_state_out_);
        addOutPort("missedDeadline", missed_deadline_out_);
        share_rtc_ports();
        return RTC::RTC_OK;
    } catch (const std::runtime_error& error) {
        log::error("{}: {}", getInstanceName(), error.what());
    } catch (const CORBA::Exception& error) { // not a std::exception
        log::error("{}: an RTC to share answers with CORBA exception {}", getInstanceName(), error._name());
    }
    disconnect_all();
    return RTC::RTC_ERROR;
}

RTC::ReturnCode_t InterceptorComp::onFinalize() {
    disconnect_all();
    return RTC::RTC_OK;
}

// For example RtcManager.exit, or an operation of an RTC that the peer calls. The reference outlives the component.
RTC::ReturnCode_t InterceptorComp::exit() {
    if (!link::in_link_thread()) return RTC::DataFlowComponentBase::exit();
    RTC::Manager::instance().invoke(
        [self = RTC::RTObject_var(getObjRef())] {
            try {
                self->exit();
            } catch (const CORBA::SystemException& error) { // another thread was faster
                log::info("InterceptorComp has already ended ({})", error._name());
            }
        },
        time_for_reply);
    return RTC::RTC_OK;
}

link::LinkOptions InterceptorComp::link_options() const {
    link::LinkOptions options;
    options.name = settings_.link;
    options.rings = {settings_.ring_bytes, settings_.large_bytes};
    options.segment_bytes = settings_.segment_bytes;
    options.group = settings_.group;
    options.wait = link::wait_options_from_environment();
    return options;
}

/// Creates the link, a mirror of each port of the RTCs, and their connections, and opens the link last: the
/// peer may call and send as soon as it is up. Throws std::runtime_error, one line, or CORBA::Exception.
void InterceptorComp::share_rtc_ports() {
    auto& manager = RTC::Manager::instance();
    engine::watch_termination(manager);
    const auto names = split_rtc_names(settings_.rtc);
    auto shared = enumerate_shared_ports(manager, settings_.rtc);
    remote_rtcs_ = std::make_unique<RemoteRtcs>(getInstanceName(), settings_, follow_remote_rtcs());
    remote_rtcs_->find(names, shared);
    if (settings_.manage) {
        built_in_services_.push_back(make_rtc_manager(manager));
        built_in_services_.push_back(make_rtc_connector());
    }
    for (const auto& service : built_in_services_) shared.table.ports.push_back(service.port());
    report_useless_parameters(shared.table);
    create_parts(shared.table);
    for (const auto& name : names)
        if (is_remote_name(name))
            activation_->add(remote_rtcs_->take(name));
        else
            drive(*manager.getComponent(name.c_str()));
    shared_ports_->share(shared);
    for (const auto& name : names)
        if (!is_remote_name(name)) shared_ports_->watch(*manager.getComponent(name.c_str()));
    link_->open();
    remote_rtcs_->watch();
    log::info("{}: sharing {} ports of {} on link '{}'", getInstanceName(), shared.ports.size(),
              shared.table.component_names(), settings_.link);
}

/// A misspelt parameter would have no effect without any message.
void InterceptorComp::report_useless_parameters(const link::PortTable& table) {
    const auto lines = find_useless_parameters(getProperties().propertyNames(), table);
    if (settings_.strict && !lines.empty()) throw std::runtime_error(lines.front());
    for (const auto& line : lines) {
        log::error("{}: {}", getInstanceName(), line);
        process::publish_notice(process::NoticeKind::setting, fmt::format("{}: {}", getInstanceName(), line));
    }
}

/// Creates the link and the objects that use it. No port is shared yet.
void InterceptorComp::create_parts(const link::PortTable& table) {
    const auto listened_changed = [this] { publish_listened_channels(); };
    link_ = std::make_unique<link::Link>(shm::Side::second, link_options(), table,
                                         static_cast<LinkHandler&>(*this));
    failures_ = std::make_unique<FailureReports>(*link_, settings_.call_timeout);
    activation_ = std::make_unique<RtcActivation>(*this, *link_, settings_.link, settings_.call_timeout);
    data_mirrors_ = std::make_unique<DataMirrors>(*this, *link_, settings_);
    service_mirrors_ = std::make_unique<ServiceMirrors>(*this, *link_, settings_);
    opros_rtcs_ = std::make_unique<OprosRtcs>(getInstanceName(), RTC::Manager::instance(), *link_,
                                              settings_.link, settings_.call_timeout, listened_changed);
    shared_ports_ = std::make_unique<SharedPorts>(*this, *link_, *data_mirrors_, *service_mirrors_,
                                                  *activation_, listened_changed);
}

void InterceptorComp::drive(RTC::RTObject_impl& rtc) {
    const std::string name = rtc.getInstanceName();
    RtcDriver::Events events;
    events.failed = [this, name](const std::string& what) { failures_->add(name, what); };
    events.activated = [this, name] { failures_->withdraw(name); };
    events.active = [this] { follow_recovery(); };
    events.deactivated_by_other = [this, name] { report_deactivation(name); };
    activation_->add(std::make_unique<RtcDriver>(rtc, settings_.call_timeout, std::move(events)));
}

/// A tool may have reset and activated an RTC that was in ERROR. The peer, which went to ERROR with it, may then continue.
void InterceptorComp::follow_recovery() {
    link_->post([this] {
        if (activation_->are_all_active()) failures_->send_recovery();
    });
}

void InterceptorComp::report_deactivation(const std::string& rtc) const {
    if (!activation_->is_activated_by_link() || engine::is_terminating()) return;
    log::warn("{}: RTC {} was deactivated, but not by the link: it neither sends nor receives until it is "
              "activated",
              getInstanceName(), rtc);
}

RemoteRtcs::Events InterceptorComp::follow_remote_rtcs() {
    RemoteRtcs::Events events;
    events.ports_changed = [this](const std::string& rtc, const std::vector<RtcPort>& ports) {
        link_->post([this, rtc, ports] {
            shared_ports_->follow(rtc, ports);
            remote_rtcs_->resume(rtc);
        });
    };
    events.gone = [this](const std::string& rtc) {
        link_->post([this, rtc] { shared_ports_->follow(rtc, {}); });
    };
    events.failed = [this](const std::string& rtc, const std::string& what) { failures_->add(rtc, what); };
    events.active = [this](const std::string& rtc) {
        failures_->withdraw(rtc);
        follow_recovery();
    };
    return events;
}

void InterceptorComp::disconnect_all() {
    if (link_) link_->close(); // first: its threads use everything below
    shared_ports_.reset();
    opros_rtcs_.reset();
    if (activation_) activation_->stop();
    activation_.reset(); // destroys the RTCs of remote_rtcs_
    remote_rtcs_.reset();
    if (data_mirrors_) data_mirrors_->close();
    if (service_mirrors_) service_mirrors_->close();
}

// ---- LinkHandler, in the link's threads

/// Refuses a table that has a port of the same name, because the channels of both share one segment.
std::string InterceptorComp::check_peer_ports(link::PortTable& peer) {
    if (const auto* same = data_mirrors_->find_same_name(peer))
        return fmt::format("link '{}': both sides share a port '{}'; rename the OPRoS component or the RTC",
                           settings_.link, same->name);
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
    service_mirrors_->unbind_required();
    opros_rtcs_->peer_lost();
    activation_->peer_lost();
}

std::optional<link::ReplyView> InterceptorComp::serve_known(const link::KnownRequest& request,
                                                            wire::MessageBuffer& memory) {
    if (auto* port = service_mirrors_->find_provided(request.id.port))
        return port->serve_known(request, memory);
    return std::nullopt;
}

Reply InterceptorComp::serve(const link::Request& request) {
    make_worker_known_to_orb();
    if (request.port.empty()) return execute_command(request);
    if (auto* port = service_mirrors_->find_provided(request.port)) return port->serve(request);
    for (const auto& service : built_in_services_)
        if (service.port().name == request.port) return service.serve(request);
    return opros_rtcs_->serve(request);
}

Reply InterceptorComp::execute_command(const link::Request& request) {
    std::string error;
    try {
        if (request.operation == control::activate) {
            error = activation_->activate();
            if (!error.empty()) failures_->set_peer_knows_failure();
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
        if (auto* port = service_mirrors_->find_required(binding.port)) {
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
    for (auto& port : data_mirrors_->listened_ports()) channels.push_back(std::move(port));
    const auto reply = link_->request_rings(channels, control::command_timeout(settings_.call_timeout));
    if (reply.status != CallStatus::ok && link_->is_up())
        log::warn("{}: data and events of OPRoS components are handed over up to 1 s late: {}",
                  getInstanceName(), reply.text());
}

void InterceptorComp::peer_ports_changed() { opros_rtcs_->update_ports(); }

void InterceptorComp::peer_connected() {
    opros_rtcs_->peer_connected();
    publish_listened_channels();
    failures_->send(); // there may have been no peer when the RTC failed
}

} // namespace tandem::interceptor
