// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/rtm/record/rtm_recorder.hpp"

#include "apps/tandem/observe/message_idl.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "apps/tandem/record/cdr_message.hpp"
#include "apps/tandem/rtm/stream/type_codes.hpp"
#include "proxy/interceptor/corba/transcoder.hpp"
#include "proxy/wire/signature_match.hpp"

#include <fmt/format.h>
#include <rtm/InterfaceSignatures.h>

#include <cstdio>
#include <span>

namespace tandem::command {
namespace {

/// Throws std::runtime_error if the type is unknown.
wire::Type known_type(const RemotePort& port, const std::string& type) {
    CORBA::TypeCode_var code = CORBA::TypeCode::_duplicate(find_type_code(type));
    if (CORBA::is_nil(code.in()))
        throw std::runtime_error(
            fmt::format("{} has type {}, which is unknown here; give the component's library with --types",
                        port.name, type));
    wire::Type message = wire::parse_signature(RTC::InterfaceSignatures::signature(code.in()));
    if (wire::contains(message, wire::Kind::unsupported))
        throw std::runtime_error(fmt::format(
            "{} has type {}, which cannot be recorded because it contains itself", port.name, type));
    return message;
}

/// Converts a message to little-endian CDR. Throws CORBA::SystemException if the bytes are not a message of the type.
std::vector<std::byte> little_endian(const wire::Type& message, const RTC::ByteData& bytes) {
    std::vector<std::byte> converted;
    cdrMemoryStream stream(bytes.getBuffer(), bytes.getDataLength());
    stream.setByteSwapFlag(bytes.getEndian());
    wire::CdrWriter out(converted);
    interceptor::to_cdr(message, stream, out);
    return converted;
}

std::uint64_t time_of(std::span<const std::byte> message) {
    wire::CdrReader reader(message);
    const auto seconds = reader.get<std::uint32_t>(), nanoseconds = reader.get<std::uint32_t>();
    return std::uint64_t{seconds} * 1'000'000'000ULL + nanoseconds;
}

} // namespace

bool RtmRecorder::add(RemotePort port, const std::vector<std::string>& properties) {
    for (const Channel& channel : ports_)
        if (channel.port->remote().object->_is_equivalent(port.object.in())) return false;
    const std::string type = require_data_type(port, "DataOutPort");
    const wire::Type message = known_type(port, type);
    const MessageIdl idl = message_idl(type, message);
    const auto dot = port.name.rfind('.');
    const std::string component = port.name.substr(0, dot == std::string::npos ? 0 : dot);
    const std::string name = port.name.substr(dot == std::string::npos ? 0 : dot + 1);
    Channel channel;
    channel.timed = wire::is_timed(message);
    channel.port =
        std::make_unique<RecordedPort>(std::move(port), message, ports_.size(), samples_, properties);
    auto& schema = schemas_[type];
    if (schema == 0) schema = writer_.add_schema(idl.name, "omgidl", bytes_of(idl.text));
    channel.id = writer_.add_channel("/" + component + "/" + name, schema, "cdr",
                                     {{"tandem.port", name},
                                      {"tandem.component", component},
                                      {"tandem.type", type},
                                      {"tandem.signature", wire::to_named_signature(message)}});
    ports_.push_back(std::move(channel));
    return true;
}

void RtmRecorder::write(const ReceivedSample& sample) {
    Channel& channel = ports_.at(sample.port);
    message_.assign(std::begin(encapsulation), std::end(encapsulation));
    const auto bytes = std::as_bytes(std::span(sample.bytes.getBuffer(), sample.bytes.getDataLength()));
    if (sample.bytes.getEndian() && wire::is_plain(channel.port->message())) {
        message_.insert(message_.end(), bytes.begin(), bytes.end());
    } else {
        try {
            const auto converted = little_endian(channel.port->message(), sample.bytes);
            message_.insert(message_.end(), converted.begin(), converted.end());
        } catch (const CORBA::SystemException&) {
            ++channel.undecodable;
            return;
        }
    }
    const auto payload = std::span(message_).subspan(sizeof encapsulation);
    writer_.write(channel.id, ++channel.sequence, sample.time_ns,
                  channel.timed ? time_of(payload) : sample.time_ns, message_);
    ++messages_;
}

void RtmRecorder::write_received(std::chrono::milliseconds timeout) {
    for (const ReceivedSample& sample : samples_.take(timeout)) write(sample);
}

void RtmRecorder::write_drops(Channel& channel, const Drops& drops) {
    if (drops == channel.drops) return;
    channel.drops = drops;
    if (drops_channel_ == 0)
        drops_channel_ = writer_.add_channel(
            "/tandem/drops", writer_.add_schema(drops_type, "omgidl", bytes_of(drops_idl)), "cdr");
    message_.assign(std::begin(encapsulation), std::end(encapsulation));
    const auto bytes = encode(channel.port->remote().name, drops);
    message_.insert(message_.end(), bytes.begin(), bytes.end());
    const std::uint64_t now = wall_clock_ns();
    writer_.write(drops_channel_, ++drops_sequence_, now, now, message_);
}

void RtmRecorder::look_after() {
    for (Channel& channel : ports_) {
        Drops drops = channel.drops;
        drops.not_recorded = channel.port->dropped() + channel.undecodable;
        if (const auto lost = channel.port->lost_by_sender()) drops.overwritten = *lost;
        write_drops(channel, drops);
        const std::uint64_t received = channel.port->received();
        if (std::exchange(channel.seen, received) != received) continue; // the connection works
        try {
            if (channel.port->restore())
                print_note("tandem: {} dropped the connection; reconnected\n", channel.port->remote().name);
        } catch (const std::runtime_error& error) {
            print_note("tandem: {}\n", error.what());
        }
    }
}

std::uint64_t RtmRecorder::not_recorded() const {
    std::uint64_t count = 0;
    for (const Channel& channel : ports_) count += channel.drops.not_recorded;
    return count;
}

std::uint64_t RtmRecorder::lost_by_senders() const {
    std::uint64_t count = 0;
    for (const Channel& channel : ports_) count += channel.drops.overwritten;
    return count;
}

} // namespace tandem::command
