// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/data/mirror_event_port.hpp"

#include "host/log/log.hpp"
#include "proxy/interceptor/engine/proxy_port.hpp"
#include "proxy/wire/signature_match.hpp"
#include "proxy/wire/time.hpp"

namespace tandem::interceptor {

MirrorEventPort::MirrorEventPort(const link::Port& port, link::ChannelReader& channel)
    : RTC::OutPortBase(port.name.c_str(), port.type.c_str()), channel_(channel) {
    addProperty("dataport.marshaling_types", "cdr");
    for (const auto& event : port.operations) {
        const auto type = wire::parse_signature(event.signature);
        if (wire::contains(type, wire::Kind::unsupported)) continue;
        const bool timed = wire::is_timed(type);
        events_[event.name] = {wire::to_signature(timed ? wire::without_time(type) : type), timed};
    }
}

void MirrorEventPort::deliver() {
    // The message is copied, so that no listener of the RTC runs while the channel is locked.
    while (channel_.read(false, [this](const shm::Record& record) { take(record); }))
        if (!id_.empty() && !send()) {
            channel_.count_discarded();
            if (undelivered_.should_log())
                log::error("port '{}': the RTC's port did not take event '{}', {} lost so far", getName(),
                           id_, undelivered_.count());
        }
}

void MirrorEventPort::take(const shm::Record& record) {
    wire::CdrReader in(snapshot_.of(record)); // the id is compared and then used
    const auto id = in.get_string(), signature = in.get_string();
    const auto argument = in.get_block(in.get_count(1), 1);
    const auto event = events_.find(id);
    id_.clear();
    if (!in.ok() || event == events_.end() || event->second.signature != signature) { // from another process
        channel_.count_undecodable_locked();                                          // read() has the lock
        if (undecodable_.should_log())
            log::error(
                "port '{}': a message of {} bytes is not an event of this port and is dropped, {} so far",
                getName(), record.bytes.size(), undecodable_.count());
        return;
    }
    id_ = id;
    const std::size_t head = event->second.timed ? 8 : 0; // of RTM's time: no alignment changes
    message_.setDataLength(head + argument.size());
    message_.isLittleEndian(true);
    wire::CdrWriter out(
        std::span(reinterpret_cast<std::byte*>(message_.getBuffer()), message_.getDataLength()));
    if (event->second.timed) {
        out.put(wire::stamp_seconds(record.stamp_ns));
        out.put(wire::stamp_nanoseconds(record.stamp_ns));
    }
    out.put_block(argument.data(), argument.size(), 1);
}

bool MirrorEventPort::send() {
    const std::lock_guard lock(m_connectorsMutex);
    for (auto* connector : m_connectors)
        if (connector->name() == id_)
            return engine::write_bytes(*connector, message_) == RTC::DataPortStatus::PORT_OK;
    return false;
}

} // namespace tandem::interceptor
