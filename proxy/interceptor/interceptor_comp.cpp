// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/interceptor_comp.hpp"

#include "proxy/interceptor/link_buffer.hpp"
#include "proxy/interceptor/mirror_in_port.hpp"
#include "proxy/interceptor/mirror_out_port.hpp"
#include "proxy/link/control.hpp"
#include "proxy/link/wait_mode.hpp"
#include "proxy/wire/signature_match.hpp"

#include <rtm/CORBA_SeqUtil.h>
#include <rtm/NVUtil.h>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

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

InterceptorComp::~InterceptorComp() { release(); }

// ---- set-up and end

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
    release();
    return RTC::RTC_ERROR;
}

RTC::ReturnCode_t InterceptorComp::onFinalize() {
    release();
    return RTC::RTC_OK;
}

void InterceptorComp::share_rtc_ports() {
    auto* rtc = RTC::Manager::instance().getComponent(settings_.rtc.c_str());
    if (!rtc)
        throw std::runtime_error(
            fmt::format("parameter 'rtc' names '{}', but there is no such RTC; create it before "
                        "this one in manager.components.precreate",
                        settings_.rtc));
    const auto ports = enumerate_ports(*rtc);
    link::PortTable table{settings_.rtc, {}};
    for (const auto& port : ports) table.ports.push_back(port.entry);
    link::LinkOptions options;
    options.name = settings_.link;
    options.rings = {settings_.ring_bytes, settings_.large_bytes};
    options.segment_bytes = settings_.segment_bytes;
    options.wait = link::wait_options_from_environment();
    link_ = std::make_unique<link::Link>(shm::Side::second, options, table, static_cast<LinkHandler&>(*this));
    driver_ = std::make_unique<RtcDriver>(*rtc, settings_.call_timeout,
                                          [this] { link_->post([this] { report_rtc_error(); }); });
    own_driver_ = std::make_unique<RtcDriver>(*this, settings_.call_timeout, [] {});
    LinkBuffer::register_factory();
    for (const auto& port : ports) {
        const bool data = port.entry.kind == PortKind::data_out || port.entry.kind == PortKind::data_in;
        data ? mirror_data_port(port) : mirror_service_port(port);
    }
    std::set<std::string> connected; // a service port with several interfaces has an entry for each
    for (const auto& port : ports) {
        if (port.corba_port.empty() || !connected.insert(port.corba_port).second) continue;
        auto& mine = *service_ports_.at(port.corba_port);
        addPort(mine);
        connect(mine, port.service, "");
    }
    link_->open();
    spdlog::info("{}: sharing {} ports of {} on link '{}'", getInstanceName(), ports.size(), settings_.rtc,
                 settings_.link);
}

std::string InterceptorComp::channel_key(const std::string& port) const {
    return settings_.link + "/" + port;
}

void InterceptorComp::mirror_data_port(const RtcPort& port) {
    const auto& entry = port.entry;
    const std::string key = channel_key(entry.name);
    LinkChannel channel;
    channel.timed = wire::is_timed(entry.signature);
    if (entry.kind == PortKind::data_out) {
        channel.writer = &link_->writer(entry.name);
        auto mine = std::make_unique<MirrorOutPort>(entry.name.c_str(), entry.type.c_str());
        addInPort(entry.name.c_str(), *mine);
        data_ports_.push_back(std::move(mine));
    } else {
        channel.reader = &link_->reader(entry.name);
        auto mine = std::make_unique<MirrorInPort>(entry.name.c_str(), entry.type.c_str());
        addOutPort(entry.name.c_str(), *mine);
        data_ports_.push_back(std::move(mine));
    }
    LinkBuffer::publish(key, channel);
    channel_keys_.push_back(key);
    connect(*data_ports_.back(), port.service, key);
}

void InterceptorComp::mirror_service_port(const RtcPort& port) {
    auto& mine = service_ports_[port.corba_port];
    if (!mine) mine = std::make_unique<RTC::CorbaPort>(port.corba_port.c_str());
    const auto& entry = port.entry;
    if (entry.kind == PortKind::service_required) {
        providers_.push_back(std::make_unique<MirrorRequiredPort>(entry, *link_, settings_.call_timeout));
        mine->registerProvider(entry.instance.c_str(), entry.type.c_str(), providers_.back()->servant());
    } else {
        consumers_.push_back(std::make_unique<MirrorProvidedPort>(entry, settings_.call_timeout));
        mine->registerConsumer(entry.instance.c_str(), entry.type.c_str(), consumers_.back()->consumer());
    }
}

void InterceptorComp::connect(RTC::PortBase& mine, RTC::PortService_ptr theirs,
                              const std::string& channel_key) {
    RTC::ConnectorProfile profile;
    profile.name = mine.getName();
    profile.connector_id = "";
    CORBA_SeqUtil::push_back(profile.ports, RTC::PortService::_duplicate(mine.getPortRef()));
    CORBA_SeqUtil::push_back(profile.ports, RTC::PortService::_duplicate(theirs));
    if (!channel_key.empty()) {
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
    if (mine.connect(profile) != RTC::RTC_OK)
        throw std::runtime_error(fmt::format("port '{}' cannot be connected with that of {}: {}",
                                             mine.getName(), settings_.rtc, mine.connectError()));
}

void InterceptorComp::release() {
    if (link_) link_->close();
    driver_.reset();
    own_driver_.reset();
    for (auto& port : data_ports_) port->disconnect_all();
    for (auto& [name, port] : service_ports_) port->disconnect_all();
    for (const auto& key : channel_keys_) LinkBuffer::withdraw(key);
    channel_keys_.clear();
}

// ---- the peer comes, goes, calls

void InterceptorComp::link_state_changed(bool up) {
    if (up) spdlog::info("{}: link '{}' is up", getInstanceName(), settings_.link);
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    link_state_.tm.sec = static_cast<CORBA::ULong>(now.tv_sec);
    link_state_.tm.nsec = static_cast<CORBA::ULong>(now.tv_nsec);
    link_state_.data.length(3);
    link_state_.data[0] = static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    link_state_.data[1] = static_cast<double>(++link_state_sequence_);
    link_state_.data[2] = up ? 1.0 : 0.0;
    link_state_out_.write();
}

void InterceptorComp::peer_disconnected() {
    if (!activated_by_link_.exchange(false)) return;
    const std::string error = driver_->deactivate();
    if (!error.empty()) spdlog::error("{}: {}: {}", getInstanceName(), settings_.rtc, error);
}

Reply InterceptorComp::serve(const link::Request& request) {
    if (request.port.empty()) return serve_control(request);
    for (auto& consumer : consumers_)
        if (consumer->port().name == request.port) return consumer->serve(request);
    return Reply::failure(CallStatus::no_such_operation, "no such service port");
}

Reply InterceptorComp::serve_control(const link::Request& request) {
    std::string error;
    if (request.operation == control::activate) {
        error = activate();
    } else if (request.operation == control::deactivate) {
        error = driver_->deactivate();
        activated_by_link_ = false;
    } else if (request.operation == control::reset) {
        error = driver_->reset();
    } else if (request.operation == control::bind) {
        error = bind(request.arguments);
    } else {
        return Reply::failure(CallStatus::no_such_operation, "unknown command");
    }
    return error.empty() ? Reply{} : Reply::failure(CallStatus::exception, error);
}

std::string InterceptorComp::activate() {
    // First, so that peer_disconnected() sees it when the peer dies meanwhile.
    activated_by_link_ = true;
    std::string error = own_driver_->activate(); // the RTC may call through our ports from its onActivated on
    if (error.empty()) error = driver_->activate();
    if (!error.empty()) activated_by_link_ = false;
    if (!link_->is_up()) peer_disconnected();
    return error;
}

std::string InterceptorComp::bind(std::span<const std::byte> arguments) {
    try {
        const auto binding = control::decode_service_binding(arguments);
        for (auto& provider : providers_)
            if (provider->port().name == binding.port) return provider->bind(binding);
        return fmt::format("there is no required service port '{}'", binding.port);
    } catch (const std::runtime_error& error) { // damaged binding, malformed signature
        return error.what();
    }
}

void InterceptorComp::peer_connected() {
    if (failed_) report_rtc_error(); // it could not be told before
}

void InterceptorComp::report_rtc_error() {
    failed_ = true;
    const auto text = control::encode_string(fmt::format("RTC '{}' went to ERROR", settings_.rtc));
    if (link_->call({"", control::failed, "", text}, settings_.call_timeout).status == CallStatus::ok)
        failed_ = false;
}

} // namespace tandem::interceptor
