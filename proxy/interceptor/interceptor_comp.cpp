// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/interceptor_comp.hpp"

#include "host/log/log.hpp"
#include "proxy/interceptor/data/forwarding_out_port.hpp"
#include "proxy/interceptor/data/link_buffer.hpp"
#include "proxy/interceptor/data/mirror_event_port.hpp"
#include "proxy/interceptor/data/mirror_in_port.hpp"
#include "proxy/interceptor/data/mirror_out_port.hpp"
#include "proxy/interceptor/drive/rtc_driver.hpp"
#include "proxy/interceptor/engine/manager.hpp"
#include "proxy/interceptor/engine/proxy_port.hpp"
#include "proxy/interceptor/manage/rtc_connector.hpp"
#include "proxy/interceptor/manage/rtc_manager.hpp"
#include "proxy/link/protocol/control.hpp"
#include "proxy/link/protocol/port_properties.hpp"
#include "proxy/link/wait_mode.hpp"
#include "proxy/wire/type_text.hpp"

#include <rtm/CORBA_SeqUtil.h>
#include <rtm/NVUtil.h>

#include <fmt/format.h>

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
    auto& [ports, table] = shared;
    if (settings_.manage) {
        built_in_services_.push_back(make_rtc_manager(manager));
        built_in_services_.push_back(make_rtc_connector());
    }
    for (const auto& service : built_in_services_) table.ports.push_back(service.port());
    table_ = table;
    report_useless_parameters();
    link_ = std::make_unique<link::Link>(shm::Side::second, link_options(), table,
                                         static_cast<LinkHandler&>(*this));
    failures_ = std::make_unique<FailureReports>(*link_, settings_.call_timeout);
    activation_ = std::make_unique<RtcActivation>(*this, *link_, settings_.link, settings_.call_timeout);
    for (const auto& name : names)
        if (is_remote_name(name))
            activation_->add(remote_rtcs_->take(name));
        else
            drive(*manager.getComponent(name.c_str()));
    LinkBuffer::register_factory();
    opros_rtcs_ =
        std::make_unique<OprosRtcs>(getInstanceName(), manager, *link_, settings_.link,
                                    settings_.call_timeout, [this] { publish_listened_channels(); });
    create_mirror_ports(ports);
    shared_ports_ = ports;
    for (const auto& name : names)
        if (!is_remote_name(name)) watch_ports(*manager.getComponent(name.c_str()));
    link_->open();
    remote_rtcs_->watch();
    log::info("{}: sharing {} ports of {} on link '{}'", getInstanceName(), ports.size(),
              table.component_names(), settings_.link);
}

/// A misspelt one would have no effect, and nobody would notice.
void InterceptorComp::report_useless_parameters() {
    const auto names = getProperties().propertyNames();
    auto lines = link::find_properties_without_port(names, table_, shm::Side::second);
    for (auto& line : link::find_unknown_parameters(names, table_)) lines.push_back(std::move(line));
    if (settings_.strict && !lines.empty()) throw std::runtime_error(lines.front());
    for (const auto& line : lines) log::error("{}: {}", getInstanceName(), line);
}

void InterceptorComp::drive(RTC::RTObject_impl& rtc) {
    activation_->add(
        std::make_unique<RtcDriver>(rtc, settings_.call_timeout,
                                    [this, name = std::string(rtc.getInstanceName())](
                                        const std::string& what) { failures_->add(name, what); }));
}

RemoteRtcs::Events InterceptorComp::follow_remote_rtcs() {
    RemoteRtcs::Events events;
    events.ports_changed = [this](const std::string& rtc, const std::vector<RtcPort>& ports) {
        link_->post([this, rtc, ports] {
            follow_remote_rtc(rtc, ports);
            remote_rtcs_->resume(rtc);
        });
    };
    events.gone = [this](const std::string& rtc) {
        link_->post([this, rtc] { follow_remote_rtc(rtc, {}); });
    };
    events.failed = [this](const std::string& rtc, const std::string& what) { failures_->add(rtc, what); };
    return events;
}

void InterceptorComp::create_mirror_ports(const std::vector<RtcPort>& ports) {
    for (const auto& port : ports)
        if (port.entry.is_event_in_port())
            create_event_mirror(port);
        else if (port.entry.has_ring())
            create_data_mirror(port);
        else if (link::is_data_port(port.entry.kind))
            leave_out(fmt::format("port '{}' of {}: type {} cannot cross the link: {}", port.entry.name,
                                  port.entry.component, port.entry.type,
                                  wire::first_unsupported(wire::parse_signature(port.entry.signature))));
        else
            create_service_mirror(port);
    std::set<std::string> added; // a service port with several interfaces is one port here
    for (const auto& port : ports)
        if (!port.service_port.empty() && added.insert(port.service_port).second)
            addPort(*service_ports_.at(port.service_port));
    for (const auto& port : ports) connect_port(port);
}

RTC::PortBase* InterceptorComp::find_mirror(const RtcPort& port) {
    if (!port.service_port.empty()) return service_ports_.at(port.service_port).get();
    auto* mirror = find_data_mirror(port.entry);
    return mirror ? mirror->port.get() : nullptr;
}

/// nullptr if there was none yet of exactly this port.
InterceptorComp::DataMirror* InterceptorComp::find_data_mirror(const link::Port& entry) {
    const auto [begin, end] = data_ports_.equal_range(entry.name);
    const auto found =
        std::find_if(begin, end, [&](const auto& each) { return each.second.entry.is_same(entry); });
    return found == end ? nullptr : &found->second;
}

void InterceptorComp::add_mirror(DataMirror mirror) {
    show(data_ports_.emplace(mirror.entry.name, std::move(mirror))->second);
}

void InterceptorComp::show(DataMirror& mirror) {
    const char* name = mirror.entry.name.c_str();
    if (auto* input = dynamic_cast<RTC::InPortBase*>(mirror.port.get()))
        addInPort(name, *input);
    else
        addOutPort(name, dynamic_cast<RTC::OutPortBase&>(*mirror.port));
    if (mirror.forward) link_->set_arrival_listener(link_->reader(mirror.entry), mirror.forward);
    mirror.shown = true;
}

void InterceptorComp::hide(DataMirror& mirror) {
    if (mirror.forward) link_->set_arrival_listener(link_->reader(mirror.entry), {});
    removePort(*mirror.port); // ends its connections
    mirror.shown = false;
}

/// Connects the port with its mirror, if it has one. An EventInPort has one connection for each of its events; a service
/// port with several interfaces has an entry for each, but is connected once.
void InterceptorComp::connect_port(const RtcPort& port) {
    auto* mirror = find_mirror(port);
    if (!mirror) return;
    const std::string& name = port.entry.name;
    if (!port.service_port.empty()) {
        const RTC::ConnectorProfileList_var present = mirror->get_connector_profiles();
        if (present->length() == 0) connect(*mirror, port, mirror->getName(), {});
        return;
    }
    if (port.is_remote) return connect_remote(*mirror, port);
    // "flush": the RTC's write() hands the data to the buffer in its own thread.
    const Properties properties{{"dataport.interface_type", "corba_cdr"},
                                {"dataport.dataflow_type", "push"},
                                {"dataport.subscription_type", "flush"},
                                {"dataport.serializer.cdr.endian", "little"}};
    if (dynamic_cast<ForwardingOutPort*>(mirror)) return connect(*mirror, port, name, properties);
    if (!port.entry.is_event_in_port()) {
        Properties of_data = properties;
        of_data.emplace_back("dataport.inport.buffer_type", LinkBuffer::factory_name);
        of_data.emplace_back("dataport.inport.buffer.channel", channel_key(port.entry));
        return connect(*mirror, port, name, of_data);
    }
    for (const auto& event : port.entry.operations) {
        Properties of_event = properties;
        of_event.emplace_back("dataport.fsm_event_name", event.name);
        of_event.emplace_back("dataport.allow_dup_connection", "YES");
        connect(*mirror, port, event.name, of_event);
    }
}

/// One port that cannot be used does not keep the others from working, unless the user asked for that.
void InterceptorComp::leave_out(const std::string& reason) {
    if (settings_.strict) throw std::runtime_error(reason);
    log::error("{}: {}; this port is left out, the others work", getInstanceName(), reason);
}

std::string InterceptorComp::channel_key(const link::Port& port) {
    return fmt::format("{}/{}#{}", settings_.link, port.name, types_.number(port));
}

void InterceptorComp::create_data_mirror(const RtcPort& port) {
    const auto& entry = port.entry;
    const std::string key = channel_key(entry);
    LinkChannel channel = make_link_channel(wire::parse_signature(entry.signature));
    set_policy(port);
    if (entry.kind == PortKind::data_out)
        channel.writer = &link_->writer(entry);
    else
        channel.reader = &link_->reader(entry);
    LinkBuffer::register_channel(key, channel);
    {
        const std::lock_guard lock(channel_keys_mutex_);
        channel_keys_.insert(key);
        channel_ports_.insert(entry.name);
    }
    const char *name = entry.name.c_str(), *type = entry.type.c_str();
    if (entry.kind == PortKind::data_out) {
        add_mirror({entry, std::make_unique<MirrorOutPort>(name, type)});
    } else if (port.is_remote || has_arrival_listener(port.reference)) { // called when a message comes
        auto mirror = std::make_unique<ForwardingOutPort>(name, type, key);
        auto& forwarding = *mirror;
        add_mirror({entry, std::move(mirror), [&forwarding] { forwarding.forward(); }});
    } else {
        add_mirror({entry, std::make_unique<MirrorInPort>(name, type)});
    }
}

/// What the parameters ask for the port.
void InterceptorComp::set_policy(const RtcPort& port) {
    const auto& entry = port.entry;
    const auto policy = link::read_port_policy("parameter", entry.name, [this](const std::string& name) {
        return getProperties().getProperty(name);
    });
    if (entry.kind == PortKind::data_out) return link_->writer(entry).set_policy(policy);
    auto& reader = link_->reader(entry);
    reader.set_policy(policy);
    reader.set_depth(entry.queue.reader_depth());
}

void InterceptorComp::create_event_mirror(const RtcPort& port) {
    auto mirror = std::make_unique<MirrorEventPort>(port.entry, link_->reader(port.entry));
    auto& events = *mirror;
    add_mirror({port.entry, std::move(mirror), [&events] { events.deliver(); }});
}

/// The mirror of exactly this interface that there was before, or a new one.
template <class Mirror, class... Arguments>
static Mirror& find_or_add(std::vector<std::unique_ptr<Mirror>>& mirrors, const link::Port& entry,
                           Arguments&&... arguments) {
    for (const auto& each : mirrors)
        if (each->port().is_same(entry)) return *each;
    return *mirrors.emplace_back(std::make_unique<Mirror>(entry, std::forward<Arguments>(arguments)...));
}

void InterceptorComp::create_service_mirror(const RtcPort& port) {
    // One CorbaPort for all interfaces of a service port, so that one connection joins them all.
    auto& mirror = service_ports_[port.service_port];
    if (!mirror) mirror = std::make_unique<RTC::CorbaPort>(port.service_port.c_str());
    const auto& entry = port.entry;
    if (entry.kind == PortKind::service_required) {
        auto& required = find_or_add(required_, entry, *link_, settings_.call_timeout);
        mirror->registerProvider(entry.instance.c_str(), entry.type.c_str(), required.servant());
        required_by_name_.add(entry.name, required, link::port_id(entry.name));
    } else {
        auto& provided = find_or_add(provided_, entry, settings_.call_timeout);
        mirror->registerConsumer(entry.instance.c_str(), entry.type.c_str(), provided.consumer());
        provided_by_name_.add(entry.name, provided, link::port_id(entry.name));
    }
}

/// Connects a mirror with the RTC's port, by a connection of that name.
void InterceptorComp::connect(RTC::PortBase& mirror, const RtcPort& port, const std::string& name,
                              const Properties& properties) {
    RTC::ConnectorProfile profile;
    profile.name = name.c_str();
    profile.connector_id = "";
    CORBA_SeqUtil::push_back(profile.ports, RTC::PortService::_duplicate(mirror.getPortRef()));
    CORBA_SeqUtil::push_back(profile.ports, RTC::PortService::_duplicate(port.reference));
    for (const auto& [key, value] : properties)
        CORBA_SeqUtil::push_back(profile.properties, NVUtil::newNV(key, value.c_str()));
    if (mirror.connect(profile) != RTC::RTC_OK)
        leave_out(fmt::format("port '{}' cannot be connected with that of {}: {}", mirror.getName(),
                              port.entry.component, engine::connect_error(mirror)));
}

void InterceptorComp::disconnect_all() {
    if (link_) link_->close(); // first: its threads use everything below
    port_watchers_.clear();
    opros_rtcs_.reset();
    activation_.reset(); // destroys the RTCs of remote_rtcs_
    remote_rtcs_.reset();
    for (auto& [name, mirror] : data_ports_) mirror.port->disconnect_all();
    for (auto& [name, port] : service_ports_) port->disconnect_all();
    for (const auto& key : channel_keys_) LinkBuffer::unregister_channel(key);
    channel_keys_.clear();
}

} // namespace tandem::interceptor
