// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/event/mirror_event_in_port.hpp"

#include "proxy/adaptor/archive/refused_text.hpp"
#include "proxy/adaptor/event/event_type.hpp"
#include "proxy/wire/time.hpp"

namespace tandem::adaptor {
namespace {

/// CORBA strings cannot hold a NUL.
void put_id(const std::string& id, wire::CdrWriter& out) {
    if (id.find('\0') != std::string::npos) throw RefusedText::with_nul();
    out.put_string(id);
}

} // namespace

bool MirrorEventInPort::accept(const opros_any& sample) {
    set_type_error(check_event_type(sample, peer_));
    const std::lock_guard lock(content_mutex_);
    if (type_error().empty()) default_content_ = sample;
    return type_error().empty();
}

ReturnType MirrorEventInPort::push(Event* event) {
    if (!event) return OPROS_BAD_INPUT_PARAMETER;
    const std::lock_guard lock(content_mutex_);
    const opros_any& content = event->getContent().empty() ? default_content_ : event->getContent();
    const std::uint64_t stamp = wire::wall_clock_stamp();
    try {
        const bool sent = channel_.write(stamp, [&](wire::CdrWriter& out) {
            put_id(event->getId(), out);
            encode_content(content, out);
        });
        return channel_.is_success(sent) ? OPROS_SUCCESS : OPROS_OUT_OF_RESOURCES;
    } catch (const std::exception& error) { // a string with a NUL in it, for instance
        channel_.refuse(error.what());
        return OPROS_BAD_INPUT_PARAMETER;
    }
}

} // namespace tandem::adaptor
