// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/typed/typed_out_port.hpp"

#include "host/log/log.hpp"

#include <fmt/format.h>

namespace tandem::adaptor {

TypedOutPort::TypedOutPort(link::Port peer, link::ChannelReader& channel, SetListener set_listener,
                           std::string convert)
    : peer_(std::move(peer)), channel_(channel), convert_(std::move(convert)),
      connections_(*this, std::move(set_listener)) {}

bool TypedOutPort::checkType(DataPort* target) {
    // An input port passes a sample to the port that it is being connected with.
    if (!target->checkType(static_cast<DataPort*>(this))) return false;
    connections_.listen_if_connected();
    return true;
}

bool TypedOutPort::checkType(opros_any& sample) {
    auto check = check_typed(sample, peer_, false, convert_);
    const std::lock_guard lock(connections_.mutex());
    if (check.error.empty() && connections_.listens() && connections_.type()->name != sample.type())
        check.error = fmt::format("port '{}': it is connected already, with ports of type {}, not {}",
                                  peer_.name, connections_.type()->name, sample.type());
    if (!check.error.empty()) {
        log::error("{}", check.error); // the engine does not say why
        record_refusal(check.error);
        return false;
    }
    if (connections_.listens()) return true;
    const ValueType* type = find_value_type(sample.type());
    connections_.set_type(type);
    check_ = std::move(check);
    value_ = type->sample();
    return true;
}

void TypedOutPort::arrived() {
    while (read_next()) push_data(value_); // every connection's queue makes a copy
}

/// Takes messages until one is a value. The ring is not locked while the value is pushed.
bool TypedOutPort::read_next() {
    bool decoded = false;
    while (!decoded)
        if (!channel_.read(false, [&](const shm::Record& record) { decoded = decode(record); })) return false;
    return true;
}

/// With the channel's lock held.
bool TypedOutPort::decode(const shm::Record& record) {
    std::string why;
    try {
        auto bytes = record.bytes;
        if (check_.conversion) {
            bytes = snapshot_.of(record); // a conversion reads some fields twice
            wire::CdrWriter out(converted_);
            if (!check_.conversion->run(wire::CdrReader(bytes), out))
                throw wire::ConversionError(check_.conversion->error());
            channel_.count_converted_locked();
            bytes = out.written();
        }
        wire::CdrReader in(bytes);
        connections_.type()->decode(value_, in);
        return true;
    } catch (const std::exception& error) { // a failed conversion, or bytes that are not a valid value
        why = error.what();
    }
    channel_.count_undecodable_locked();
    if (undecodable_.should_log())
        log::error("port '{}': a message of {} bytes does not decode ({}) and is dropped, {} so far",
                   peer_.name, record.bytes.size(), why, undecodable_.count());
    return false;
}

} // namespace tandem::adaptor
