// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/typed/typed_event_out_port.hpp"

#include "host/log/log.hpp"
#include "proxy/adaptor/event/event_type.hpp"

#include <fmt/format.h>

namespace tandem::adaptor {

bool TypedEventOutPort::checkType(EventPort* target) {
    // An input port shows an event to whatever it is to be connected with.
    if (!target->checkType(static_cast<EventPort*>(this))) return false;
    listen_if_connected();
    return true;
}

bool TypedEventOutPort::checkType(Event* event) {
    const auto* type = event ? find_content_type(*event) : nullptr;
    const std::lock_guard lock(mutex_);
    std::string error = check_event_type(type ? type->sample() : opros_any(), peer_);
    if (error.empty() && listens_ && type != type_)
        error = fmt::format("port '{}': it is connected already, with events of content {}, not {}",
                            peer_.name, type_->name, type->name);
    if (!error.empty()) {
        log::error("{}", error); // the engine does not say why
        return false;
    }
    if (listens_) return true;
    type_ = type;
    content_ = type->sample();
    event_ = type->make_event();
    return true;
}

/// Engines add a connection before or after they have had its target checked.
void TypedEventOutPort::listen_if_connected() {
    {
        const std::lock_guard lock(mutex_);
        if (listens_ || !type_ || connections_.empty()) return;
        listens_ = true;
    }
    set_listener_(this);
}

/// The listener first: this waits for the thread in arrived().
void TypedEventOutPort::stop_listening() {
    set_listener_(nullptr);
    const std::lock_guard lock(mutex_);
    listens_ = false;
    type_ = nullptr;
}

void TypedEventOutPort::addConnection(IEventPortLink* connection) {
    OutputEventPortInterface::addConnection(connection);
    {
        const std::lock_guard lock(mutex_);
        connections_.insert(connection);
    }
    listen_if_connected();
}

void TypedEventOutPort::removeConnection(IEventPortLink* connection) {
    bool is_last = false;
    {
        const std::lock_guard lock(mutex_);
        is_last = connections_.erase(connection) == 1 && connections_.empty() && listens_;
    }
    if (is_last) stop_listening();
    OutputEventPortInterface::removeConnection(connection);
}

void TypedEventOutPort::clearConnection() {
    bool listened = false;
    {
        const std::lock_guard lock(mutex_);
        connections_.clear();
        listened = listens_;
    }
    if (listened) stop_listening();
    OutputEventPortInterface::clearConnection();
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
            type_->decode(content_, in);
            event_->setId(id);
            event_->setContent(content_);
            return true;
        } catch (const std::exception& error) { // bytes that are no value
            why = error.what();
        }
    channel_.count_undecodable_locked();
    if (undecodable_.should_log())
        log::error("port '{}': a message of {} bytes is no event ({}) and is dropped, {} so far", peer_.name,
                   record.bytes.size(), why, undecodable_.count());
    return false;
}

} // namespace tandem::adaptor
