// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/mirrored_input.hpp"

#include "proxy/adaptor/cdr_archive.hpp"
#include "proxy/adaptor/type_check.hpp"
#include "proxy/wire/match.hpp"
#include "proxy/wire/time.hpp"

namespace tandem::adaptor {

MirroredInput::MirroredInput(link::Port partner, link::ChannelWriter& channel)
    : partner_(std::move(partner)), channel_(channel) {}

bool MirroredInput::checkType(opros_any& sample) {
    const auto check = check_type(sample, partner_);
    type_error_ = check.error;
    if (!check.error.empty()) return false;
    value_has_time_ = wire::is_timed(partner_.signature) && check.match == wire::Match::equal;
    return true;
}

ReturnType MirroredInput::push(opros_any& value) {
    try {
        const bool sent = value_has_time_ ? push_timed(value)
                                          : channel_.write(wire::stamp_now(), [&](wire::CdrWriter& out) {
                                                CdrOarchive archive(out);
                                                value.encode(archive);
                                            });
        return sent ? OPROS_SUCCESS : OPROS_OUT_OF_RESOURCES;
    } catch (const std::exception&) {
        return OPROS_BAD_INPUT_PARAMETER; // a value, not a type, that cannot cross: a string with a NUL in it
    }
}

/// The value brings RTM's time itself: on the wire that goes into the header, so it is encoded aside and
/// split.
bool MirroredInput::push_timed(opros_any& value) {
    thread_local std::vector<std::byte> aside;
    wire::CdrWriter writer(aside);
    CdrOarchive archive(writer);
    value.encode(archive);
    wire::CdrReader time(aside);
    const auto sec = time.get<std::uint32_t>(), nsec = time.get<std::uint32_t>();
    const auto rest = std::span<const std::byte>(aside).subspan(time.position());
    return channel_.write(wire::pack_time(sec, nsec),
                          [&](wire::CdrWriter& out) { out.put_block(rest.data(), rest.size(), 1); });
}

} // namespace tandem::adaptor
