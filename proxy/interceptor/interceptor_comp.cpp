// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/interceptor_comp.hpp"

#include "proxy/interceptor/data/link_buffer.hpp"
#include "proxy/interceptor/data/mirror_in_port.hpp"
#include "proxy/interceptor/data/mirror_out_port.hpp"
#include "proxy/link/protocol/control.hpp"
#include "proxy/link/wait_mode.hpp"
#include "proxy/wire/signature_match.hpp"
#include "proxy/wire/type_text.hpp"

#include <rtm/CORBA_SeqUtil.h>
#include <rtm/NVUtil.h>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <ctime>
#include <set>
#include <stdexcept>

namespace tandem::interceptor {
namespace control = link::control;
using link::CallStatus;
using link::PortKind;
using link::Reply;

InterceptorComp::InterceptorComp(RTC::Manager* manager)
    : RTC::DataFlowComponentBase(manager), link_state_out_("linkState", link_state_) {}

InterceptorComp::~InterceptorComp() { disconnect_all(); }

// ---- set-up and end, in the manager's thread

RTC::ReturnCode_t InterceptorComp::onInitialize() {
    try {
        settings_ = read_settings(getProperties());
        addOutPort("linkState", link_state_out_);
        share_rtc_ports();
        return RTC::RTC_OK;
    } catch (const std::runtime_error& error) {
        spdlog::error("{}: {}", getInstanceName(), error.what());
    } catch (const CORBA::Exception& error) { // not a std::exception
        spdlog::error("{}: {} answers with CORBA exception {}", getInstanceName(), settings_.rtc,
                      error._name());
    }
    disconnect_all();
    return RTC::RTC_ERROR;
}

RTC::ReturnCode_t InterceptorComp::onFinalize() {
    disconnect_all();
    return RTC::RTC_OK;
}

/// Creates the link, a mirror of each port of the RTC, and their connections, and opens the link last: the
/// peer may call and send as soon as it is up. Throws std::runtime_error, one line, or CORBA::Exception.
void InterceptorComp::share_rtc_ports() {
    auto& manager = RTC::Manager::instance();
    RTC::RTObject_impl* rtc = settings_.rtc.empty() ? nullptr : manager.getComponent(settings_.rtc.c_str());
    if (!rtc && !settings_.rtc.empty())
        throw std::runtime_error(
            fmt::format("parameter 'rtc' names '{}', but there is no such RTC; create it before "
                        "this one in manager.components.precreate",
                        settings_.rtc));
    const auto ports = rtc ? enumerate_ports(*rtc) : std::vector<RtcPort>{};
    link::PortTable table;
    if (rtc) table.components.push_back({settings_.rtc, rtc->getTypeName()});
    for (const auto& port : ports) table.ports.push_back(port.entry);
    link::LinkOptions options;
    options.name = settings_.link;
    options.rings = {settings_.ring_bytes, settings_.large_bytes};
    options.segment_bytes = settings_.segment_bytes;
    options.group = settings_.group;
    options.wait = link::wait_options_from_environment();
    link_ = std::make_unique<link::Link>(shm::Side::second, options, table, static_cast<LinkHandler&>(*this));
    LinkBuffer::register_factory();
    opros_rtcs_ = std::make_unique<OprosRtcs>(getInstanceName(), manager, *link_, settings_.link,
                                              settings_.call_timeout);
    // The report waits for the peer, and so must not run in the thread of the RTC's execution context.
    if (rtc)
        rtc_driver_ = std::make_unique<RtcDriver>(*rtc, settings_.call_timeout,
                                                  [this] { link_->post([this] { report_rtc_error(); }); });
    own_driver_ = std::make_unique<RtcDriver>(*this, settings_.call_timeout, [] {});
    create_mirror_ports(ports);
    link_->open();
    spdlog::info("{}: sharing {} ports of {} on link '{}'", getInstanceName(), ports.size(),
                 table.component_names(), settings_.link);
}

void InterceptorComp::create_mirror_ports(const std::vector<RtcPort>& ports) {
    for (const auto& port : ports)
        if (port.entry.has_ring())
            create_data_mirror(port);
        else if (link::is_data_port(port.entry.kind))
            leave_out(fmt::format("port '{}' of {}: type {} cannot cross the link: {}", port.entry.name,
                                  settings_.rtc, port.entry.type,
                                  wire::first_unsupported(wire::parse_signature(port.entry.signature))));
        else
            create_service_mirror(port);
    // A service port with several interfaces has an entry for each, but is connected once.
    std::set<std::string> connected;
    for (const auto& port : ports) {
        if (port.service_port.empty() || !connected.insert(port.service_port).second) continue;
        auto& mirror = *service_ports_.at(port.service_port);
        addPort(mirror);
        connect(mirror, port.reference, "");
    }
}

/// One port that cannot be used does not keep the others from working, unless the user asked for that.
void InterceptorComp::leave_out(const std::string& reason) {
    if (settings_.strict) throw std::runtime_error(reason);
    spdlog::error("{}: {}; this port is left out, the others work", getInstanceName(), reason);
}

std::string InterceptorComp::channel_key(const std::string& port) const {
    return settings_.link + "/" + port;
}

void InterceptorComp::create_data_mirror(const RtcPort& port) {
    const auto& entry = port.entry;
    const std::string key = channel_key(entry.name);
    LinkChannel channel;
    const auto type = wire::parse_signature(entry.signature);
    channel.timed = wire::is_timed(type);
    if (wire::contains(type, wire::Kind::any) || wire::contains(type, wire::Kind::fixed))
        channel.transcoded =
            std::make_shared<const wire::Type>(channel.timed ? wire::without_time(type) : type);
    if (entry.kind == PortKind::data_out) {
        channel.writer = &link_->writer(entry.name);
        written_ports_.push_back(entry.name);
        auto mirror = std::make_unique<MirrorOutPort>(entry.name.c_str(), entry.type.c_str());
        addInPort(entry.name.c_str(), *mirror);
        data_ports_.push_back(std::move(mirror));
    } else {
        channel.reader = &link_->reader(entry.name);
        auto mirror = std::make_unique<MirrorInPort>(entry.name.c_str(), entry.type.c_str());
        addOutPort(entry.name.c_str(), *mirror);
        data_ports_.push_back(std::move(mirror));
    }
    LinkBuffer::register_channel(key, channel);
    channel_keys_.push_back(key);
    connect(*data_ports_.back(), port.reference, key);
}

void InterceptorComp::create_service_mirror(const RtcPort& port) {
    // One CorbaPort for all interfaces of a service port, so that one connection joins them all.
    auto& mirror = service_ports_[port.service_port];
    if (!mirror) mirror = std::make_unique<RTC::CorbaPort>(port.service_port.c_str());
    const auto& entry = port.entry;
    if (entry.kind == PortKind::service_required) {
        required_.push_back(std::make_unique<MirrorRequiredPort>(entry, *link_, settings_.call_timeout));
        mirror->registerProvider(entry.instance.c_str(), entry.type.c_str(), required_.back()->servant());
    } else {
        provided_.push_back(std::make_unique<MirrorProvidedPort>(entry, settings_.call_timeout));
        mirror->registerConsumer(entry.instance.c_str(), entry.type.c_str(), provided_.back()->consumer());
    }
}

/// Connects a mirror with the RTC's port. For a data port, `channel_key` tells the connector's buffer which
/// channel of the link it is.
void InterceptorComp::connect(RTC::PortBase& mirror, RTC::PortService_ptr rtc_port,
                              const std::string& channel_key) {
    RTC::ConnectorProfile profile;
    profile.name = mirror.getName();
    profile.connector_id = "";
    CORBA_SeqUtil::push_back(profile.ports, RTC::PortService::_duplicate(mirror.getPortRef()));
    CORBA_SeqUtil::push_back(profile.ports, RTC::PortService::_duplicate(rtc_port));
    if (!channel_key.empty()) {
        // "flush": the RTC's write() hands the data to the buffer in its own thread.
        const std::pair<const char*, const char*> properties[] = {
            {"dataport.interface_type", "corba_cdr"},
            {"dataport.dataflow_type", "push"},
            {"dataport.subscription_type", "flush"},
            {"dataport.serializer.cdr.endian", "little"},
            {"dataport.buffer_type", LinkBuffer::factory_name},
            {"dataport.buffer.channel", channel_key.c_str()}};
        for (const auto& [name, value] : properties)
            CORBA_SeqUtil::push_back(profile.properties, NVUtil::newNV(name, value));
    }
    if (mirror.connect(profile) != RTC::RTC_OK)
        leave_out(fmt::format("port '{}' cannot be connected with that of {}: {}", mirror.getName(),
                              settings_.rtc, mirror.connectError()));
}

void InterceptorComp::disconnect_all() {
    if (link_) link_->close(); // first: its threads use everything below
    opros_rtcs_.reset();
    rtc_driver_.reset();
    own_driver_.reset();
    for (auto& port : data_ports_) port->disconnect_all();
    for (auto& [name, port] : service_ports_) port->disconnect_all();
    for (const auto& key : channel_keys_) LinkBuffer::unregister_channel(key);
    channel_keys_.clear();
}

// ---- the peer connects, disconnects, calls

/// Refuses a table that has a port of the same name, because the channels of both share one segment.
std::string InterceptorComp::check_peer_ports(link::PortTable& peer) {
    for (const auto& port : peer.ports)
        if (std::find(channel_keys_.begin(), channel_keys_.end(), channel_key(port.name)) !=
            channel_keys_.end())
            return fmt::format(
                "link '{}': both sides share a port '{}'; rename the OPRoS component or the RTC",
                settings_.link, port.name);
    opros_rtcs_->set_peer_table(peer);
    return "";
}

void InterceptorComp::link_state_changed(bool up) {
    if (up) spdlog::info("{}: link '{}' is up", getInstanceName(), settings_.link);
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

void InterceptorComp::peer_disconnected() {
    opros_rtcs_->peer_lost();
    deactivate_if_activated_by_link();
}

void InterceptorComp::deactivate_if_activated_by_link() {
    // An RTC that somebody else has activated keeps running: it does not depend on the link.
    if (!activated_by_link_.exchange(false) || !rtc_driver_) return;
    const std::string error = rtc_driver_->deactivate();
    if (!error.empty()) spdlog::error("{}: {}: {}", getInstanceName(), settings_.rtc, error);
}

Reply InterceptorComp::serve(const link::Request& request) {
    if (request.port.empty()) return execute_command(request);
    for (auto& port : provided_)
        if (port->port().name == request.port) return port->serve(request);
    return Reply::failure(CallStatus::no_such_operation, "no such service port");
}

Reply InterceptorComp::execute_command(const link::Request& request) {
    std::string error;
    if (request.operation == control::activate) {
        error = activate();
    } else if (request.operation == control::deactivate) {
        error = rtc_driver_ ? rtc_driver_->deactivate() : "";
        activated_by_link_ = false;
    } else if (request.operation == control::reset) {
        error = rtc_driver_ ? rtc_driver_->reset() : "";
    } else if (request.operation == control::state) {
        error = receive_state(request);
    } else if (request.operation == control::bind) {
        error = bind(request.arguments);
    } else if (request.operation == control::listen) {
        error = listen(request.arguments);
    } else {
        return Reply::failure(CallStatus::no_such_operation, "unknown command");
    }
    return error.empty() ? Reply{} : Reply::failure(CallStatus::exception, error);
}

std::string InterceptorComp::activate() {
    // Set first, so that peer_disconnected() sees it when the peer dies meanwhile.
    activated_by_link_ = true;
    // This component before the RTC, which may send and call through the mirrors from its onActivated on.
    std::string error = own_driver_->activate();
    if (error.empty() && rtc_driver_) error = rtc_driver_->activate();
    if (!error.empty()) activated_by_link_ = false;
    // The peer may have gone before the RTC was active: then nobody else deactivates it.
    if (!link_->is_up()) deactivate_if_activated_by_link();
    return error;
}

std::string InterceptorComp::receive_state(const link::Request& request) {
    try {
        opros_rtcs_->receive_state(request);
        return "";
    } catch (const link::LinkError& error) {
        return error.what();
    }
}

std::string InterceptorComp::bind(std::span<const std::byte> arguments) {
    try {
        const auto binding = control::decode_service_binding(arguments);
        for (auto& port : required_)
            if (port->port().name == binding.port) return port->bind(binding);
        return fmt::format("there is no required service port '{}'", binding.port);
    } catch (const std::runtime_error& error) { // damaged binding, malformed signature
        return error.what();
    }
}

/// Rings the peer's doorbell from now on for messages of the ports in the list, and of no others.
std::string InterceptorComp::listen(std::span<const std::byte> arguments) {
    try {
        const auto names = control::decode_port_names(arguments);
        for (const auto& port : written_ports_)
            link_->writer(port).set_peer_listens(std::find(names.begin(), names.end(), port) != names.end());
        return "";
    } catch (const link::LinkError& error) {
        return error.what();
    }
}

void InterceptorComp::peer_connected() {
    opros_rtcs_->peer_connected();
    if (unreported_error_) report_rtc_error(); // there was no peer when the RTC went to ERROR
}

void InterceptorComp::report_rtc_error() {
    unreported_error_ = true;
    const auto text = control::encode_string(fmt::format("RTC '{}' went to ERROR", settings_.rtc));
    // Until the peer has it, peer_connected() tries again.
    if (link_->call({"", control::failed, "", text}, settings_.call_timeout).status == CallStatus::ok)
        unreported_error_ = false;
}

} // namespace tandem::interceptor
