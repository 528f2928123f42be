// SPDX-License-Identifier: Apache-2.0
#include "proxy/adaptor/typed/typed_in_port.hpp"

#include "host/log/log.hpp"
#include "proxy/wire/time.hpp"

#include <algorithm>

namespace tandem::adaptor {

TypedInPort::TypedInPort(link::Port peer, link::ChannelWriter& channel, std::string convert)
    : peer_(std::move(peer)), channel_(channel), convert_(std::move(convert)) {}

bool TypedInPort::checkType(opros_any& sample) {
    auto check = check_typed(sample, peer_, true, convert_);
    const std::lock_guard lock(mutex_);
    if (!check.error.empty()) {
        log::error("{}", check.error); // the engine does not say why
        record_refusal(check.error);
        return false;
    }
    const auto* type = find_value_type(sample.type());
    if (std::none_of(encodings_.begin(), encodings_.end(),
                     [&](const auto& each) { return each->type == type; }))
        encodings_.push_back(std::make_unique<Encoding>(Encoding{type, std::move(check)}));
    return true;
}

/// Looks the type up by name each time, because an output port passes on any opros_any that its component pushes.
TypedInPort::Encoding* TypedInPort::find_encoding(opros_any& value) {
    const std::string type = value.type();
    const std::lock_guard lock(mutex_);
    const auto at = std::find_if(encodings_.begin(), encodings_.end(),
                                 [&](const auto& each) { return each->type->name == type; });
    return at == encodings_.end() ? nullptr : at->get();
}

ReturnType TypedInPort::push(opros_any& value) {
    Encoding* encoding = find_encoding(value);
    if (!encoding) return OPROS_BAD_INPUT_PARAMETER;
    try {
        const bool converts = encoding->check.conversion.has_value();
        const bool sent = converts ? send_converted(value, *encoding)
                                   : channel_.write(wire::wall_clock_stamp(), [&](wire::CdrWriter& out) {
                                         encoding->type->encode(value, out);
                                     });
        return channel_.is_success(sent) ? OPROS_SUCCESS : OPROS_OUT_OF_RESOURCES;
    } catch (const std::exception& error) { // of the conversion, or a string with a NUL in it
        channel_.refuse(error.what());
        return OPROS_BAD_INPUT_PARAMETER;
    }
}

bool TypedInPort::send_converted(opros_any& value, Encoding& encoding) {
    const std::lock_guard lock(conversion_mutex_);
    wire::CdrWriter out(encoded_);
    encoding.type->encode(value, out);
    const std::uint64_t stamp = wire::wall_clock_stamp();
    const bool sent = channel_.write_expecting(converted_bytes_, stamp, [&](wire::CdrWriter& message) {
        if (!encoding.check.conversion->run(wire::CdrReader(out.written()), message))
            throw wire::ConversionError(encoding.check.conversion->error());
    });
    if (sent) channel_.count_converted();
    return sent;
}

} // namespace tandem::adaptor
