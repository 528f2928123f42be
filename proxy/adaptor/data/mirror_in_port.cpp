// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/data/mirror_in_port.hpp"

#include "proxy/adaptor/archive/cdr_archive.hpp"
#include "proxy/adaptor/archive/type_check.hpp"
#include "proxy/wire/signature_match.hpp"
#include "proxy/wire/time.hpp"

namespace tandem::adaptor {

MirrorInPort::MirrorInPort(link::Port peer, link::ChannelWriter& channel)
    : peer_(std::move(peer)), channel_(channel) {}

bool MirrorInPort::checkType(opros_any& sample) {
    const auto check = check_type(sample, peer_, true);
    type_error_ = check.error;
    if (!check.error.empty()) {
        refusals_.push_back(check.error);
        return false;
    }
    value_has_time_ = wire::is_timed(peer_.signature) && check.match == wire::SignatureMatch::equal;
    return true;
}

ReturnType MirrorInPort::push(opros_any& value) {
    std::uint64_t stamp = value_has_time_ ? 0 : wire::wall_clock_stamp();
    try {
        // The channel reads `stamp` after this function has run, so the archive may still set it.
        const bool sent = channel_.write(stamp, [&](wire::CdrWriter& out) {
            CdrOarchive archive = value_has_time_ ? CdrOarchive(out, stamp) : CdrOarchive(out);
            value.encode(archive);
        });
        return sent ? OPROS_SUCCESS : OPROS_OUT_OF_RESOURCES;
    } catch (const std::exception&) {
        // checkType() has accepted the type; single values may still not cross, as a string with a NUL in it.
        return OPROS_BAD_INPUT_PARAMETER;
    }
}

} // namespace tandem::adaptor
