// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::link {

/// The kind of a port, from the view of the component that has it.
enum class PortKind : std::uint32_t { data_out, data_in, service_provided, service_required };

/// Replaces the signature of a type without one: `?{reason}`. The port is shared so that the peer can report why it
/// cannot be connected, but no data pass through it.
inline constexpr char no_signature = '?';

inline bool is_data_port(PortKind kind) { return kind == PortKind::data_out || kind == PortKind::data_in; }

/// One operation of a service interface.
struct ServiceOperation {
    std::string name;
    std::string signature; ///< `arguments:result`, see docs/wire_format.md
    bool operator==(const ServiceOperation&) const = default;
};

/// The queue of a port that receives.
struct QueuePolicy {
    enum class Full : std::uint32_t { overwrite, refuse, wait };
    std::uint32_t length = 0; ///< maximum number of waiting messages; 0: as many as the ring holds
    Full full = Full::overwrite;
    std::uint32_t wait_ms = 0; ///< with Full::wait
    bool operator==(const QueuePolicy&) const = default;
    /// Returns how many of the newest messages the reader reads. 0: all, because the writer holds messages back.
    std::uint32_t reader_depth() const { return full == Full::overwrite ? length : 0; }
};

/// One port that a side shares. The peer creates a mirror with the same name.
struct Port {
    PortKind kind{};
    std::string name;
    std::string type;      ///< the name in its own model, for messages: `IDL:RTC/TimedDouble:1.0`, `Chair`
    std::string signature; ///< data ports: signature of the message, including a leading time
    std::string instance;  ///< service ports: name of the interface instance
    /// Service ports: the operations; empty if the model cannot tell. A port that takes events by their ids: its events,
    /// each with the signature of its argument, or an empty one. A message is an event's id and its argument, `sv`.
    std::vector<ServiceOperation> operations;
    std::string component{}; ///< the component with the port: a name in PortTable::components
    QueuePolicy queue{};     ///< of a data port that receives
    /// Selects one of the rings with this name: a port that gets another type gets another ring. Set by the link.
    std::uint32_t ring = 0;
    bool operator==(const Port&) const = default;

    /// Returns true if both are the same port. Ignores the ring, which differs between sessions.
    bool is_same(const Port& other) const;
    /// Returns true for a data port that takes events by their ids, such as an EventInPort of OpenRTM-aist.
    bool is_event_in_port() const { return kind == PortKind::data_in && !operations.empty(); }
    /// Returns true for a data port whose messages cross the link. Such a port has a ring.
    bool has_ring() const { return is_data_port(kind) && signature.find(no_signature) == std::string::npos; }
};

/// A setting of a component with its value at the creation of the table.
struct Property {
    std::string name, value;
    bool operator==(const Property&) const = default;
};

/// A component that a side shares.
struct SharedComponent {
    std::string name;
    std::string type{};                 ///< the name in its own model
    std::vector<Property> properties{}; ///< empty if its settings are not shared
    bool operator==(const SharedComponent&) const = default;
};

/// Everything that a side shares. The side publishes the table in the segment, and the peer reads it when it connects.
struct PortTable {
    std::vector<SharedComponent> components;
    std::vector<Port> ports; ///< of all components; each name occurs once
    /// The component model of the side, for log messages: `OPRoS`, `RTM`. Empty if the side has none, or if the table is older
    /// than this field. A proxy sets it (proxy/adaptor/model.hpp, proxy/interceptor/model.hpp).
    std::string model{};
    bool operator==(const PortTable&) const = default;

    const Port* find(std::string_view name) const; ///< Returns nullptr if there is no port of this name.
    std::string component_names() const;           ///< for log messages: `A, B`
};

/// Encodes in CDR. Components: count; for each: name, type, number of properties, and the name and value of each
/// property. Ports: count; for each: kind, name, type, signature, instance, operations, component, queue and ring. Then the
/// model, which tables in recordings before 0.3 do not have.
std::vector<std::byte> encode(const PortTable&);
/// Decodes bytes from another process. Throws LinkError if they are not a table.
PortTable decode_port_table(std::span<const std::byte>);

/// Returns the encoded table as hexadecimal digits, for a property of a component.
std::string encode_as_text(const PortTable&);
/// Throws LinkError if the text is not a table.
PortTable decode_port_table_text(std::string_view text);

} // namespace tandem::link
