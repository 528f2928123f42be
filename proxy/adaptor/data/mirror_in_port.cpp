// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/data/mirror_in_port.hpp"

#include "proxy/adaptor/archive/cdr_archive.hpp"
#include "proxy/adaptor/archive/pictures.hpp"
#include "proxy/wire/time.hpp"

#include <algorithm>

namespace tandem::adaptor {

MirrorInPort::MirrorInPort(link::Port peer, link::ChannelWriter& channel, std::string convert)
    : peer_(std::move(peer)), channel_(channel), convert_(std::move(convert)) {}

bool MirrorInPort::checkType(opros_any& sample) {
    auto check = check_type(sample, peer_, true, convert_);
    type_error_ = check.error;
    record_refusal(check.error);
    if (!check.error.empty()) return false;
    const std::lock_guard lock(encodings_mutex_);
    if (std::none_of(encodings_.begin(), encodings_.end(),
                     [&](const auto& each) { return each->type == sample.type(); })) {
        const bool converts = check.conversion || check.set_time || check.pictures;
        const bool plain = !converts && !check.value_has_time;
        encodings_.push_back(
            std::make_unique<Encoding>(Encoding{sample.type(), std::move(check), converts, plain}));
    }
    sole_encoding_.store(encodings_.size() == 1 ? encodings_.front().get() : nullptr,
                         std::memory_order_release);
    return true;
}

/// Needed only if ports of several types push here, because the name costs an allocation.
MirrorInPort::Encoding* MirrorInPort::find_encoding_by_name(const opros_any& value) {
    const std::string type = value.type();
    const std::lock_guard lock(encodings_mutex_);
    const auto at = std::find_if(encodings_.begin(), encodings_.end(),
                                 [&](const auto& each) { return each->type == type; });
    return at == encodings_.end() ? nullptr : at->get();
}

ReturnType MirrorInPort::push(opros_any& value) {
    const Encoding* const encoding = sole_encoding_.load(std::memory_order_acquire);
    const auto* const held = value.held();
    if (encoding && encoding->plain && held && held->elementBytes() != 0) [[likely]] {
        const std::uint64_t stamp = wire::wall_clock_stamp();
        const auto elements = held->elements();
        using Sent = link::ChannelWriter::Sent;
        const Sent sent = channel_.write_numbers(
            {static_cast<const std::byte*>(elements.begin), elements.bytes}, held->elementBytes(), stamp);
        if (sent != Sent::too_long) return result_of(sent == Sent::yes);
    }
    return push_by_archive(value);
}

ReturnType MirrorInPort::push_by_archive(opros_any& value) {
    Encoding* found = sole_encoding_.load(std::memory_order_acquire);
    if (!found) [[unlikely]]
        found = find_encoding_by_name(value);
    if (!found) return OPROS_BAD_INPUT_PARAMETER;
    Encoding& encoding = *found;
    TypeCheck& check = encoding.check;
    try {
        if (encoding.converts) return rt::rehearsing() ? OPROS_SUCCESS : push_converted(value, check);
        std::uint64_t stamp = check.value_has_time ? 0 : wire::wall_clock_stamp();
        // The channel reads `stamp` after this function has run, so the archive may still set it.
        const bool sent = channel_.write(stamp, [&](wire::CdrWriter& out) {
            CdrOarchive archive(out, check.value_has_time ? &stamp : nullptr);
            value.encode(archive);
        });
        return result_of(sent);
    } catch (const std::exception& error) {
        // checkType() has accepted the type, but a single value may not be able to cross, for example a string with a NUL.
        if (!rt::rehearsing()) channel_.refuse(error.what());
        return OPROS_BAD_INPUT_PARAMETER;
    }
}

/// From the bytes of the value straight into the memory in which the message travels.
ReturnType MirrorInPort::push_converted(opros_any& value, TypeCheck& check) {
    const std::lock_guard lock(conversion_mutex_);
    std::uint64_t stamp = 0;
    wire::CdrWriter out(encoded_);
    CdrOarchive archive(out, check.value_has_time ? &stamp : nullptr);
    value.encode(archive);
    if (!check.value_has_time || check.set_time) stamp = wire::wall_clock_stamp();
    if (check.pictures)
        if (const auto why =
                picture_error(*check.pictures, wire::CdrReader(out.written()), PictureBytes::or_more);
            !why.empty())
            throw wire::ConversionError(why);
    const bool sent = channel_.write_expecting(converted_bytes_, stamp, [&](wire::CdrWriter& message) {
        if (!check.conversion)
            message.put_block(out.written().data(), out.size(), 1);
        else if (!check.conversion->run(wire::CdrReader(out.written()), message))
            throw wire::ConversionError(check.conversion->error());
    });
    if (sent && (check.conversion || check.set_time)) channel_.count_converted();
    return result_of(sent);
}

} // namespace tandem::adaptor
