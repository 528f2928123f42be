// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::link {

/// What a port is to the component that has it.
enum class PortKind : std::uint32_t { data_out, data_in, service_provided, service_required };

/// Stands in a signature for a type that has none; `?{reason}`. A port with it is shared, so that the peer can say
/// why it cannot be connected, but no data pass through it.
inline constexpr char no_signature = '?';

inline bool is_data_port(PortKind kind) { return kind == PortKind::data_out || kind == PortKind::data_in; }

/// One operation of a service interface.
struct ServiceOperation {
    std::string name;
    std::string signature; ///< `arguments:result`, see proxy/wire/README.md
    bool operator==(const ServiceOperation&) const = default;
};

/// The buffer of an InPort of RTM, by `buffer.*` of rtc.conf or as it is without.
struct QueuePolicy {
    enum class Full : std::uint32_t { overwrite, refuse, wait };
    std::uint32_t length = 0; ///< messages that wait at most; 0: as many as the ring holds
    Full full = Full::overwrite;
    std::uint32_t wait_ms = 0; ///< with Full::wait
    bool operator==(const QueuePolicy&) const = default;
    /// How many messages the reader looks back; 0: to the oldest, since the writer holds the newest back.
    std::uint32_t reader_depth() const { return full == Full::overwrite ? length : 0; }
};

/// One port that a side shares with its peer, which creates a mirror of the same name.
struct Port {
    PortKind kind{};
    std::string name;
    std::string type;      ///< as its own model calls it, for messages: `IDL:RTC/TimedDouble:1.0`, `Chair`
    std::string signature; ///< data ports: of the message, RTM's leading time included
    std::string instance;  ///< service ports: name of the interface instance
    /// Service ports: empty when the model cannot tell. Of an EventInPort: its events, each with the signature of its
    /// argument, empty for none; a message is an event's id and its argument, `sv`.
    std::vector<ServiceOperation> operations;
    std::string component{}; ///< whose port it is: a name in PortTable::components
    QueuePolicy queue{};     ///< of a data port that receives
    /// Which of the rings of its name carries its messages: a port that gets another type gets another ring. Set by the link.
    std::uint32_t ring = 0;
    bool operator==(const Port&) const = default;

    /// Whether it is the same port, whichever ring it has: that is another one in each session.
    bool is_same(const Port& other) const;
    /// Whether it is an EventInPort of RTM: a data port that takes events by their ids.
    bool is_event_in_port() const { return kind == PortKind::data_in && !operations.empty(); }
    /// Whether it is a data port whose messages cross the link, and which so has a ring.
    bool has_ring() const { return is_data_port(kind) && signature.find(no_signature) == std::string::npos; }
};

/// A setting of a component and its value when the table was made.
struct Property {
    std::string name, value;
    bool operator==(const Property&) const = default;
};

/// A component that a side shares.
struct SharedComponent {
    std::string name;
    std::string type{};                 ///< as its own model calls it
    std::vector<Property> properties{}; ///< empty for an RTC, whose configuration is not shared
    bool operator==(const SharedComponent&) const = default;
};

/// What a side shares. It publishes this in the segment; the peer reads it when it connects.
struct PortTable {
    std::vector<SharedComponent> components;
    std::vector<Port> ports; ///< of all components; each name occurs once
    bool operator==(const PortTable&) const = default;

    const Port* find(std::string_view name) const; ///< nullptr if there is none of that name
    std::string component_names() const;           ///< for messages: `A, B`
};

/// In CDR: count, and of each component name, type, count, and of each property name and value; then count, and of
/// each port kind, name, type, signature, instance, operations, component, queue and ring.
std::vector<std::byte> encode(const PortTable&);
/// Throws LinkError when the bytes, which another process wrote, are no table.
PortTable decode_port_table(std::span<const std::byte>);

/// The same bytes as hexadecimal digits, for a property of a component.
std::string encode_as_text(const PortTable&);
/// Throws LinkError when the text is no table.
PortTable decode_port_table_text(std::string_view text);

} // namespace tandem::link
