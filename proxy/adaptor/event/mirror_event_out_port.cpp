// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/event/mirror_event_out_port.hpp"

#include "host/log/log.hpp"
#include "proxy/adaptor/archive/cdr_archive.hpp"
#include "proxy/adaptor/archive/pictures.hpp"
#include "proxy/adaptor/event/event_type.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace tandem::adaptor {
namespace {

/// What a message holds: the event's id, and its content.
wire::Type message_of(wire::Type content) {
    wire::Type id, message;
    id.kind = wire::Kind::string;
    message.children = {std::move(id), std::move(content)};
    return message;
}

} // namespace

MirrorEventOutPort::MirrorEventOutPort(link::Port peer, link::ChannelReader& channel,
                                       SetListener set_listener)
    : peer_(std::move(peer)), channel_(channel), set_listener_(std::move(set_listener)) {}

bool MirrorEventOutPort::checkType(EventPort* target) {
    const opros_any sample = target->sample();
    const std::lock_guard lock(mutex_);
    wire::Type content;
    type_error_ = check_event_type(sample, peer_, &content);
    if (type_error_.empty() && !connections_.empty() && sample.type() != content_.type())
        type_error_ = fmt::format("port '{}': it is connected already, with events of content {}", peer_.name,
                                  content_.type());
    record_refusal(type_error_);
    if (type_error_.empty() && connections_.empty()) {
        content_ = sample;
        pictures_ = pictures_in(message_of(std::move(content)));
    }
    return type_error_.empty();
}

bool MirrorEventOutPort::checkType(Event* event) {
    const std::lock_guard lock(mutex_);
    if (connections_.empty()) prototype_.reset(event->clone());
    return true;
}

void MirrorEventOutPort::addConnection(IEventPortLink* connection) {
    OutputEventPortInterface::addConnection(connection);
    bool is_first = false;
    {
        const std::lock_guard lock(mutex_);
        is_first = connections_.insert(connection).second && connections_.size() == 1;
    }
    if (is_first) set_listener_(this);
}

void MirrorEventOutPort::removeConnection(IEventPortLink* connection) {
    bool is_last = false;
    {
        const std::lock_guard lock(mutex_);
        is_last = connections_.size() == 1 && connections_.contains(connection);
    }
    if (is_last) set_listener_(nullptr); // first: it waits for the thread in send()
    {
        const std::lock_guard lock(mutex_);
        connections_.erase(connection);
    }
    OutputEventPortInterface::removeConnection(connection);
}

void MirrorEventOutPort::arrived() {
    while (channel_.read(false, [this](const shm::Record& record) { send(record); })) continue;
}

void MirrorEventOutPort::send(const shm::Record& record) {
    try {
        const auto bytes = snapshot_.of(record); // read twice
        if (pictures_)
            if (const auto why = picture_error(*pictures_, wire::CdrReader(bytes), PictureBytes::exact);
                !why.empty())
                throw std::runtime_error(why);
        CdrIarchive archive{wire::CdrReader(bytes)};
        archive.load(prototype_->getId());
        content_.decode(archive);
        prototype_->setContent(content_);
        // Every connection makes a copy, and logs it if its receiver has no room.
        if (push_event(prototype_.get()) == OPROS_OUT_OF_RESOURCES) channel_.count_discarded_locked();
    } catch (const std::exception& error) {
        channel_.count_undecodable_locked(); // read() has the lock
        if (undecodable_.should_log())
            log::error("port '{}': a message of {} bytes is not an event ({}) and is dropped, {} so far",
                       peer_.name, record.bytes.size(), error.what(), undecodable_.count());
    }
}

} // namespace tandem::adaptor
