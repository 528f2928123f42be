// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/event/mirror_event_in_port.hpp"

#include "proxy/adaptor/archive/cdr_archive.hpp"
#include "proxy/adaptor/event/event_type.hpp"
#include "proxy/wire/time.hpp"

namespace tandem::adaptor {

bool MirrorEventInPort::checkType(EventPort* source) {
    const opros_any sample = source->sample();
    type_error_ = check_event_type(sample, peer_);
    const std::lock_guard lock(content_mutex_);
    if (type_error_.empty()) default_content_ = sample;
    return type_error_.empty();
}

ReturnType MirrorEventInPort::push(Event* event) {
    if (!event) return OPROS_BAD_INPUT_PARAMETER;
    const std::lock_guard lock(content_mutex_);
    const opros_any& content = event->getContent().empty() ? default_content_ : event->getContent();
    const std::uint64_t stamp = wire::wall_clock_stamp();
    try {
        const bool sent = channel_.write(stamp, [&](wire::CdrWriter& out) {
            CdrOarchive archive(out);
            archive.save(event->getId());
            content.encode(archive);
        });
        return sent ? OPROS_SUCCESS : OPROS_OUT_OF_RESOURCES;
    } catch (const std::exception&) {
        return OPROS_BAD_INPUT_PARAMETER; // a string with a NUL in it, for instance
    }
}

} // namespace tandem::adaptor
