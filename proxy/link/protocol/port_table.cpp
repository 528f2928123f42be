// SPDX-License-Identifier: Apache-2.0
#include "proxy/link/protocol/port_table.hpp"

#include "proxy/link/protocol/link_error.hpp"
#include "proxy/link/protocol/service_operations.hpp"

#include <algorithm>
#include <charconv>

namespace tandem::link {
namespace {

// Minimum sizes of a port, a property and a component in bytes. A count that exceeds the table's size is refused.
constexpr std::size_t min_port_bytes = 45, min_property_bytes = 13, min_component_bytes = 17;

void put(wire::CdrWriter& out, const Port& port) {
    out.put(static_cast<std::uint32_t>(port.kind));
    for (const auto* text : {&port.name, &port.type, &port.signature, &port.instance}) out.put_string(*text);
    put(out, port.operations);
    out.put_string(port.component);
    out.put(port.queue.length);
    out.put(static_cast<std::uint32_t>(port.queue.full));
    out.put(port.queue.wait_ms);
    out.put(port.ring);
}

void put(wire::CdrWriter& out, const SharedComponent& component) {
    out.put_string(component.name);
    out.put_string(component.type);
    out.put(static_cast<std::uint32_t>(component.properties.size()));
    for (const auto& [name, value] : component.properties) {
        out.put_string(name);
        out.put_string(value);
    }
}

void put(wire::CdrWriter& out, const PortTable& table) {
    out.put(static_cast<std::uint32_t>(table.components.size()));
    for (const auto& component : table.components) put(out, component);
    out.put(static_cast<std::uint32_t>(table.ports.size()));
    for (const Port& port : table.ports) put(out, port);
    out.put_string(table.model);
}

Port get_port(wire::CdrReader& in) {
    Port port;
    port.kind = static_cast<PortKind>(in.get<std::uint32_t>());
    if (port.kind > PortKind::service_required)
        throw LinkError("the peer's port table has a port of unknown kind");
    for (auto* text : {&port.name, &port.type, &port.signature, &port.instance}) *text = in.get_string();
    port.operations = get_service_operations(in);
    port.component = in.get_string();
    port.queue.length = in.get<std::uint32_t>();
    port.queue.full = static_cast<QueuePolicy::Full>(in.get<std::uint32_t>());
    port.queue.wait_ms = in.get<std::uint32_t>();
    port.ring = in.get<std::uint32_t>();
    if (port.queue.full > QueuePolicy::Full::wait)
        throw LinkError("the peer's port table has a queue of unknown policy");
    return port;
}

SharedComponent get_component(wire::CdrReader& in) {
    SharedComponent component;
    component.name = in.get_string();
    component.type = in.get_string();
    component.properties.resize(in.get_count(min_property_bytes));
    for (auto& [name, value] : component.properties) {
        name = in.get_string();
        value = in.get_string();
    }
    return component;
}

} // namespace

bool Port::is_same(const Port& other) const {
    Port same = other;
    same.ring = ring;
    return *this == same;
}

const Port* PortTable::find(std::string_view name) const {
    const auto at =
        std::find_if(ports.begin(), ports.end(), [&](const Port& port) { return port.name == name; });
    return at == ports.end() ? nullptr : &*at;
}

std::string PortTable::component_names() const {
    std::string names;
    for (const auto& component : components) names += (names.empty() ? "" : ", ") + component.name;
    return names.empty() ? "no component" : names;
}

std::vector<std::byte> encode(const PortTable& table) {
    wire::CdrWriter measure({}); // only counts
    put(measure, table);
    std::vector<std::byte> bytes(measure.size());
    wire::CdrWriter writer(bytes);
    put(writer, table);
    return bytes;
}

PortTable decode_port_table(std::span<const std::byte> bytes) {
    wire::CdrReader in(bytes);
    PortTable table;
    const std::uint32_t components = in.get_count(min_component_bytes);
    // A damaged entry ends the loops, so that a wrong count does not make them read millions of zeros.
    for (std::uint32_t i = 0; i < components && in.ok(); ++i) table.components.push_back(get_component(in));
    const std::uint32_t count = in.get_count(min_port_bytes);
    table.ports.reserve(count);
    for (std::uint32_t i = 0; i < count && in.ok(); ++i) table.ports.push_back(get_port(in));
    if (in.ok() && in.position() < bytes.size()) table.model = in.get_string();
    if (!in.ok())
        throw LinkError("the peer's port table is damaged: it ends early or holds a malformed string");
    return table;
}

std::string encode_as_text(const PortTable& table) {
    static constexpr char digits[] = "0123456789abcdef";
    std::string text;
    for (const std::byte byte : encode(table)) {
        text += digits[std::to_integer<unsigned>(byte) >> 4];
        text += digits[std::to_integer<unsigned>(byte) & 15];
    }
    return text;
}

PortTable decode_port_table_text(std::string_view text) {
    std::vector<std::byte> bytes(text.size() / 2);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        unsigned value = 0;
        const char* begin = text.data() + 2 * i;
        if (std::from_chars(begin, begin + 2, value, 16).ptr != begin + 2)
            throw LinkError("a port table as text consists of pairs of hexadecimal digits");
        bytes[i] = static_cast<std::byte>(value);
    }
    return decode_port_table(bytes);
}

} // namespace tandem::link
