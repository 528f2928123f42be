// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/service_mirrors.hpp"

#include <set>
#include <utility>

namespace tandem::interceptor {
namespace {

/// Returns the mirror of exactly this interface, or a new one if there is none.
template <class Mirror, class... Arguments>
Mirror& find_or_add(std::vector<std::unique_ptr<Mirror>>& mirrors, const link::Port& entry,
                    Arguments&&... arguments) {
    for (const auto& each : mirrors)
        if (each->port().is_same(entry)) return *each;
    return *mirrors.emplace_back(std::make_unique<Mirror>(entry, std::forward<Arguments>(arguments)...));
}

} // namespace

ServiceMirrors::ServiceMirrors(RTC::RTObject_impl& owner, link::Link& link, const Settings& settings)
    : owner_(owner), link_(link), settings_(settings), connector_(owner, settings.strict) {}

void ServiceMirrors::create(const std::vector<RtcPort>& ports) {
    for (const auto& port : ports)
        if (!port.service_port.empty()) create_interface(port);
    std::set<std::string> added; // a service port with several interfaces is one port here
    for (const auto& port : ports)
        if (!port.service_port.empty() && added.insert(port.service_port).second)
            owner_.addPort(*ports_.at(port.service_port));
}

void ServiceMirrors::create_interface(const RtcPort& port) {
    // One CorbaPort for all interfaces of a service port, so that one connection joins them all.
    auto& mirror = ports_[port.service_port];
    if (!mirror) mirror = std::make_unique<RTC::CorbaPort>(port.service_port.c_str());
    const auto& entry = port.entry;
    if (entry.kind == link::PortKind::service_required) {
        auto& required = find_or_add(required_, entry, link_, settings_.call_timeout);
        mirror->registerProvider(entry.instance.c_str(), entry.type.c_str(), required.servant());
        required_by_name_.add(entry.name, required, link::port_id(entry.name));
    } else {
        auto& provided = find_or_add(provided_, entry, settings_.call_timeout);
        mirror->registerConsumer(entry.instance.c_str(), entry.type.c_str(), provided.consumer());
        provided_by_name_.add(entry.name, provided, link::port_id(entry.name));
    }
}

void ServiceMirrors::replace(const std::string& service_port, const std::vector<RtcPort>& ports) {
    auto& mirror = ports_.at(service_port);
    owner_.removePort(*mirror); // ends its connections
    mirror.reset();
    for (const auto& port : ports)
        if (port.service_port == service_port) create_interface(port);
    owner_.addPort(*mirror);
}

void ServiceMirrors::connect(const RtcPort& port) {
    RTC::PortBase& mirror = *ports_.at(port.service_port);
    const RTC::ConnectorProfileList_var present = mirror.get_connector_profiles();
    if (present->length() != 0) return;
    const std::string why = connector_.connect(mirror, port, mirror.getName(), {});
    if (auto* provided = provided_by_name_.find(port.entry.name)) provided->leave_out(why);
}

void ServiceMirrors::disconnect(const std::string& service_port) {
    ports_.at(service_port)->disconnect_all();
}

void ServiceMirrors::activate(const std::string& service_port) {
    static_cast<RTC::PortBase&>(*ports_.at(service_port)).activateInterfaces();
}

void ServiceMirrors::unbind_required() {
    for (auto& port : required_) port->unbind();
}

void ServiceMirrors::close() {
    for (auto& [name, port] : ports_) port->disconnect_all();
}

} // namespace tandem::interceptor
