// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/typed/typed_event_out_port.hpp"

#include "host/log/log.hpp"
#include "proxy/adaptor/event/event_type.hpp"

#include <fmt/format.h>

namespace tandem::adaptor {

bool TypedEventOutPort::checkType(EventPort* target) {
    // An input port passes a sample event to the port that it is being connected with.
    if (!target->checkType(static_cast<EventPort*>(this))) return false;
    connections_.listen_if_connected();
    return true;
}

bool TypedEventOutPort::checkType(Event* event) {
    const auto* type = event ? find_content_type(*event) : nullptr;
    const std::lock_guard lock(connections_.mutex());
    std::string error = check_event_type(type ? type->sample() : opros_any(), peer_);
    if (error.empty() && connections_.listens() && type != connections_.type())
        error = fmt::format("port '{}': it is connected already, with events of content {}, not {}",
                            peer_.name, connections_.type()->name, type->name);
    if (!error.empty()) {
        log::error("{}", error); // the engine does not say why
        record_refusal(error);
        return false;
    }
    if (connections_.listens()) return true;
    connections_.set_type(type);
    content_ = type->sample();
    event_ = type->make_event();
    return true;
}

void TypedEventOutPort::arrived() {
    while (read_next()) push_event(event_.get()); // every connection makes a copy
}

/// Takes messages until one is an event. The ring is not locked while the event is pushed.
bool TypedEventOutPort::read_next() {
    bool decoded = false;
    while (!decoded)
        if (!channel_.read(false, [&](const shm::Record& record) { decoded = decode(record); })) return false;
    return true;
}

/// With the channel's lock held.
bool TypedEventOutPort::decode(const shm::Record& record) {
    wire::CdrReader in(record.bytes);
    const std::string id(in.get_string());
    std::string why = "it begins with no id";
    if (in.ok()) try {
            connections_.type()->decode(content_, in);
            event_->setId(id);
            event_->setContent(content_);
            return true;
        } catch (const std::exception& error) { // bytes that are not a value
            why = error.what();
        }
    channel_.count_undecodable_locked();
    if (undecodable_.should_log())
        log::error("port '{}': a message of {} bytes is not an event ({}) and is dropped, {} so far",
                   peer_.name, record.bytes.size(), why, undecodable_.count());
    return false;
}

} // namespace tandem::adaptor
