// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/data_mirrors.hpp"

#include "proxy/interceptor/data/forwarding_out_port.hpp"
#include "proxy/interceptor/data/link_buffer.hpp"
#include "proxy/interceptor/data/mirror_event_port.hpp"
#include "proxy/interceptor/data/mirror_in_port.hpp"
#include "proxy/interceptor/data/mirror_out_port.hpp"
#include "proxy/wire/type_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tandem::interceptor {
namespace {

using link::PortKind;

/// "flush": the RTC's write() stores the data in the buffer, in the thread of the RTC.
PortConnector::Properties local_properties() {
    return {{"dataport.interface_type", "corba_cdr"},
            {"dataport.dataflow_type", "push"},
            {"dataport.subscription_type", "flush"},
            {"dataport.serializer.cdr.endian", "little"}};
}

/// "new": neither the remote RTC's cycle nor the thread that delivers messages of the link waits for the other process.
PortConnector::Properties remote_properties() {
    return {{"dataport.interface_type", "corba_cdr"}, {"dataport.dataflow_type", "push"},
            {"dataport.subscription_type", "new"},    {"dataport.publisher.push_policy", "all"},
            {"dataport.outport.buffer.length", "64"}, {"dataport.serializer.cdr.endian", "little"}};
}

} // namespace

DataMirrors::DataMirrors(RTC::RTObject_impl& owner, link::Link& link, const Settings& settings)
    : owner_(owner), link_(link), settings_(settings), connector_(owner, settings.strict) {
    LinkBuffer::register_factory();
}

void DataMirrors::create(const RtcPort& port) {
    const auto& entry = port.entry;
    if (entry.is_event_in_port())
        create_event_mirror(port);
    else if (entry.has_ring())
        create_data_mirror(port);
    else
        connector_.leave_out(fmt::format("port '{}' of {}: type {} cannot cross the link: {}", entry.name,
                                         entry.component, entry.type,
                                         wire::first_unsupported(wire::parse_signature(entry.signature))));
}

void DataMirrors::create_data_mirror(const RtcPort& port) {
    const auto& entry = port.entry;
    const std::string key = channel_key(entry);
    LinkChannel channel = make_link_channel(wire::parse_signature(entry.signature));
    set_policy(entry);
    if (entry.kind == PortKind::data_out)
        channel.writer = &link_.writer(entry);
    else
        channel.reader = &link_.reader(entry);
    LinkBuffer::register_channel(key, channel);
    {
        const std::lock_guard lock(channel_keys_mutex_);
        channel_keys_.insert(key);
        channel_ports_.insert(entry.name);
    }
    const char *name = entry.name.c_str(), *type = entry.type.c_str();
    if (entry.kind == PortKind::data_out) {
        add({entry, std::make_unique<MirrorOutPort>(name, type)});
    } else if (port.is_remote || has_arrival_listener(port.reference)) { // called when a message comes
        auto mirror = std::make_unique<ForwardingOutPort>(name, type, key);
        auto& forwarding = *mirror;
        add({entry, std::move(mirror), [&forwarding] { forwarding.forward(); }});
    } else {
        add({entry, std::make_unique<MirrorInPort>(name, type)});
    }
}

void DataMirrors::create_event_mirror(const RtcPort& port) {
    auto mirror = std::make_unique<MirrorEventPort>(port.entry, link_.reader(port.entry));
    auto& events = *mirror;
    add({port.entry, std::move(mirror), [&events] { events.deliver(); }});
}

std::string DataMirrors::channel_key(const link::Port& port) {
    return fmt::format("{}/{}#{}", settings_.link, port.name, types_.number(port));
}

void DataMirrors::add(Mirror mirror) { show(mirrors_.emplace(mirror.entry.name, std::move(mirror))->second); }

void DataMirrors::show(Mirror& mirror) {
    const char* name = mirror.entry.name.c_str();
    if (auto* input = dynamic_cast<RTC::InPortBase*>(mirror.port.get()))
        owner_.addInPort(name, *input);
    else
        owner_.addOutPort(name, dynamic_cast<RTC::OutPortBase&>(*mirror.port));
    if (mirror.forward) link_.set_arrival_listener(link_.reader(mirror.entry), mirror.forward);
    mirror.shown = true;
}

bool DataMirrors::restore(const link::Port& port) {
    auto* mirror = find(port);
    if (!mirror) return false;
    if (port.kind == PortKind::data_in) link_.reader(port).discard();
    set_policy(port);
    show(*mirror);
    return true;
}

void DataMirrors::hide(const link::Port& port) {
    auto* mirror = find(port);
    if (!mirror) return;
    if (mirror->forward) link_.set_arrival_listener(link_.reader(mirror->entry), {});
    owner_.removePort(*mirror->port); // ends its connections
    mirror->shown = false;
}

/// Returns nullptr if there is no mirror of exactly this port.
DataMirrors::Mirror* DataMirrors::find(const link::Port& port) {
    const auto [begin, end] = mirrors_.equal_range(port.name);
    const auto found =
        std::find_if(begin, end, [&](const auto& each) { return each.second.entry.is_same(port); });
    return found == end ? nullptr : &found->second;
}

void DataMirrors::connect(const RtcPort& port) {
    auto* mirror = find(port.entry);
    if (!mirror) return;
    if (port.entry.is_event_in_port() && !port.is_remote) return connect_events(*mirror, port);
    auto properties = port.is_remote ? remote_properties() : local_properties();
    if (!dynamic_cast<ForwardingOutPort*>(mirror->port.get())) {
        // Only for the connector of this side: OpenRTM-aist's ports do not know this buffer type.
        properties.emplace_back("dataport.inport.buffer_type", LinkBuffer::factory_name);
        properties.emplace_back("dataport.inport.buffer.channel", channel_key(port.entry));
    }
    connector_.connect(*mirror->port, port, port.entry.name, properties);
}

void DataMirrors::connect_events(Mirror& mirror, const RtcPort& port) {
    for (const auto& event : port.entry.operations) {
        auto properties = local_properties();
        properties.emplace_back("dataport.fsm_event_name", event.name);
        properties.emplace_back("dataport.allow_dup_connection", "YES");
        connector_.connect(*mirror.port, port, event.name, properties);
    }
}

void DataMirrors::disconnect(const link::Port& port) {
    if (auto* mirror = find(port)) mirror->port->disconnect_all();
}

void DataMirrors::set_policy(const link::Port& port) {
    const auto policy = link::read_port_policy("parameter", port.name, [this](const std::string& name) {
        return owner_.getProperties().getProperty(name);
    });
    if (port.kind == PortKind::data_out) return link_.writer(port).set_policy(policy);
    auto& reader = link_.reader(port);
    reader.set_policy(policy);
    reader.set_depth(port.queue.reader_depth());
}

std::vector<std::string> DataMirrors::listened_ports() const {
    std::vector<std::string> names;
    for (const auto& [name, mirror] : mirrors_)
        if (mirror.shown && mirror.forward) names.push_back(name);
    return names;
}

const link::Port* DataMirrors::find_same_name(const link::PortTable& table) const {
    const std::lock_guard lock(channel_keys_mutex_);
    for (const auto& port : table.ports)
        if (channel_ports_.contains(port.name)) return &port;
    return nullptr;
}

void DataMirrors::close() {
    for (auto& [name, mirror] : mirrors_) mirror.port->disconnect_all();
    for (const auto& key : channel_keys_) LinkBuffer::unregister_channel(key);
    channel_keys_.clear();
}

} // namespace tandem::interceptor
