// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/rtc_port.hpp"

#include "proxy/interceptor/engine/data_types.hpp"
#include "proxy/interceptor/engine/manager.hpp"
#include "proxy/interceptor/model.hpp"
#include "proxy/interceptor/remote/remote_rtc.hpp"
#include "proxy/interceptor/service/interface_operations.hpp"
#include "proxy/wire/type.hpp"

#include <rtm/NVUtil.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace tandem::interceptor {
namespace {

using link::PortKind;

std::string property(const RTC::PortProfile& profile, const char* key) {
    return NVUtil::toString(profile.properties, key);
}

/// Returns the signature of a data port's type, or a refusal if it contains an object reference, which nobody would keep alive.
std::string without_references(const wire::Type& type) {
    if (wire::contains(type, wire::Kind::object)) return "?{it holds an object reference}";
    return wire::to_named_signature(type);
}

/// The signature of an IDL type, known from the IDL that the RTC's library was built with.
std::string data_signature(const std::string& type) {
    const std::string signature = engine::data_type_signature(type);
    if (signature.empty())
        return "?{its IDL is not known to the RTM host; build the RTC's IDL with it, or load a library that "
               "has it}";
    try {
        return without_references(wire::parse_signature(signature));
    } catch (const wire::SignatureError& error) {
        return "?{" + error.reason() + "}";
    }
}

/// Returns the signature of an event's argument. The port gets its bytes unchanged.
std::string argument_signature(const std::string& type) {
    std::string signature = data_signature(type);
    const auto parsed = wire::parse_signature(signature);
    if (wire::contains(parsed, wire::Kind::any) || wire::contains(parsed, wire::Kind::fixed))
        return "?{the argument of an event cannot contain an any or a fixed}";
    return signature;
}

/// The events of an EventInPort, which its profile lists as `NAME` or `NAME=TYPE`.
std::vector<link::ServiceOperation> events_of(const RTC::PortProfile& profile) {
    std::vector<link::ServiceOperation> events;
    for (const auto& event : coil::split(property(profile, "dataport.fsm_events"), ",", true)) {
        const auto equals = event.find('=');
        events.push_back({event.substr(0, equals),
                          equals == std::string::npos ? "" : argument_signature(event.substr(equals + 1))});
    }
    return events;
}

/// The port's buffer: its settings `buffer.*` from rtc.conf, or the defaults of OpenRTM's RingBuffer.
link::QueuePolicy queue_of(const RTC::PortProfile& profile) {
    link::QueuePolicy queue;
    queue.length = 8;
    double length = 0, timeout_s = 1;
    if (coil::stringTo(length, property(profile, "buffer.length").c_str()) && length >= 1 && length <= 1e6)
        queue.length = static_cast<std::uint32_t>(length);
    coil::stringTo(timeout_s, property(profile, "buffer.write.timeout").c_str());
    const std::string full = coil::normalize(property(profile, "buffer.write.full_policy"));
    if (full.empty() || full == "overwrite") return queue;
    queue.full = link::QueuePolicy::Full::refuse;
    if (full != "block") return queue;
    queue.full = link::QueuePolicy::Full::wait;
    queue.wait_ms = timeout_s > 0 && timeout_s < 1e6 ? static_cast<std::uint32_t>(1000 * timeout_s) : 0;
    return queue;
}

/// Returns the part of this policy that applies in the link. An InPort that gets each message on arrival has another buffer
/// behind the link; its sender waits only if that buffer's policy says so.
link::QueuePolicy queue_in_link(const RTC::PortProfile& profile, RTC::PortService_ptr reference) {
    const auto queue = queue_of(profile);
    const bool waits = queue.full == link::QueuePolicy::Full::wait;
    return waits || !has_arrival_listener(reference) ? queue : link::QueuePolicy{};
}

link::Port data_port(const RTC::PortProfile& profile, PortKind kind, RTC::PortService_ptr reference) {
    link::Port port;
    port.kind = kind;
    port.name = short_name(profile);
    port.type = property(profile, "dataport.data_type");
    port.operations = events_of(profile);
    if (kind == PortKind::data_in && port.operations.empty()) port.queue = queue_in_link(profile, reference);
    port.signature = port.is_event_in_port() ? "{id}s{argument}v" : data_signature(port.type);
    return port;
}

link::Port service_port(const RTC::PortProfile& profile, const RTC::PortInterfaceProfile& interface) {
    link::Port port;
    port.kind = interface.polarity == RTC::PROVIDED ? PortKind::service_provided : PortKind::service_required;
    port.name = short_name(profile);
    port.instance = interface.instance_name;
    if (profile.interfaces.length() > 1) port.name += "." + port.instance;
    port.type = interface.type_name;
    port.operations = operations_of(port.type);
    return port;
}

void put_component_in_front(RtcPort& port) {
    const std::string prefix = port.entry.component + ".";
    port.entry.name = prefix + port.entry.name;
    if (!port.service_port.empty()) port.service_port = prefix + port.service_port;
}

/// Prefixes a port's name with the RTC's name and a dot if several RTCs have a port of that name.
void make_names_unique(std::vector<RtcPort>& ports) {
    const auto own_name = [](const RtcPort& port) {
        return port.service_port.empty() ? port.entry.name : port.service_port;
    };
    std::map<std::string, std::set<std::string>> components; // the components that have a port of that name
    for (const auto& port : ports) components[own_name(port)].insert(port.entry.component);
    for (auto& port : ports) {
        if (components.at(own_name(port)).size() < 2) continue;
        put_component_in_front(port);
    }
}

} // namespace

std::string short_name(const RTC::PortProfile& profile) {
    const std::string full(profile.name);
    const auto dot = full.rfind('.');
    return dot == std::string::npos ? full : full.substr(dot + 1);
}

bool has_arrival_listener(RTC::PortService_ptr port) {
    PortableServer::ServantBase_var servant;
    try {
        servant = RTC::Manager::instance().thePOA()->reference_to_servant(port);
    } catch (const PortableServer::POA::WrongAdapter&) { // of another process
        return false;
    } catch (const PortableServer::POA::ObjectNotActive&) {
        return false;
    }
    auto* in_port = dynamic_cast<RTC::InPortBase*>(servant.in());
    return in_port && engine::wants_arrivals(*in_port);
}

namespace {

std::vector<RtcPort> ports_of(const RTC::PortServiceList& services, const std::string& component) {
    std::vector<RtcPort> ports;
    std::set<std::string> names{"linkState", "missedDeadline"}; // taken by the proxies' own ports
    for (CORBA::ULong i = 0; i < services.length(); ++i) {
        RTC::PortService_var reference = RTC::PortService::_duplicate(services[i]);
        RTC::PortProfile_var profile = reference->get_port_profile();
        if (!names.insert(short_name(profile)).second) continue; // of two ports of one name, the first counts
        const std::string kind = property(profile, "port.port_type");
        if (kind == "DataOutPort")
            ports.push_back({data_port(profile, PortKind::data_out, reference), "", reference});
        else if (kind == "DataInPort")
            ports.push_back({data_port(profile, PortKind::data_in, reference), "", reference});
        else
            for (CORBA::ULong j = 0; j < profile->interfaces.length(); ++j)
                ports.push_back(
                    {service_port(profile, profile->interfaces[j]), short_name(profile), reference});
    }
    for (auto& port : ports) port.entry.component = component;
    return ports;
}

} // namespace

std::vector<RtcPort> enumerate_ports(RTC::RTObject_impl& rtc) {
    const RTC::PortServiceList_var services = rtc.get_ports();
    return ports_of(services.in(), rtc.getInstanceName());
}

std::vector<RtcPort> enumerate_remote_ports(const RTC::PortServiceList& services,
                                            const std::string& component, bool is_only) {
    auto ports = ports_of(services, component);
    for (auto& port : ports) {
        port.is_remote = true;
        port.entry.queue = {}; // the CORBA connection and the port have their own queues
        // Each event has a separate connection, and connections to another process do not keep a common order.
        if (port.entry.is_event_in_port()) {
            port.entry.operations.clear();
            port.entry.signature =
                "?{events for a state machine of another process would lose their order; load "
                "InterceptorComp in its own host}";
        }
        if (!is_only) put_component_in_front(port);
    }
    return ports;
}

std::vector<std::string> split_rtc_names(std::string names) {
    std::replace(names.begin(), names.end(), ';', ',');
    return coil::split(names, ",", true);
}

SharedRtcs enumerate_shared_ports(RTC::Manager& manager, const std::string& names) {
    SharedRtcs shared;
    shared.table.model = model;
    for (const auto& name : split_rtc_names(names)) {
        if (is_remote_name(name)) continue;
        auto* rtc = manager.getComponent(name.c_str());
        if (!rtc)
            throw std::runtime_error(
                fmt::format("parameter 'rtc' names '{}', but there is no such RTC; create it before "
                            "this one in manager.components.precreate, or give rtcname://HOST:PORT/Name0 or "
                            "rtcloc://HOST:PORT/Name0 of another process",
                            name));
        shared.table.components.push_back({name, rtc->getTypeName()});
        for (auto& port : enumerate_ports(*rtc)) shared.ports.push_back(std::move(port));
    }
    make_names_unique(shared.ports);
    for (const auto& port : shared.ports) shared.table.ports.push_back(port.entry);
    return shared;
}

link::PortTable look_up_shared_ports(RTC::Manager& manager, const std::string& names) {
    const auto all = split_rtc_names(names);
    auto table = enumerate_shared_ports(manager, names).table;
    for (const auto& name : all) {
        if (!is_remote_name(name)) continue;
        std::string reason;
        RemoteRtc rtc(manager, "tandem", name, std::chrono::seconds(1), {});
        const auto services = rtc.find(reason);
        if (!reason.empty()) throw std::runtime_error(reason);
        const std::string component = instance_of(name);
        table.components.push_back({component, remote_type});
        for (const auto& port : enumerate_remote_ports(services, component, all.size() == 1))
            table.ports.push_back(port.entry);
    }
    return table;
}

} // namespace tandem::interceptor
