// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/record/call_writer.hpp"

#include "apps/tandem/observe/message_idl.hpp"
#include "apps/tandem/record/cdr_message.hpp"
#include "proxy/link/protocol/request.hpp"
#include "proxy/link/protocol/service_exception.hpp"
#include "proxy/wire/cdr.hpp"
#include "proxy/wire/operation.hpp"

#include <fmt/format.h>

#include <string_view>

namespace tandem::command {
namespace {

constexpr const char* failure_signature = "{call}t{status}s{text}s{bytes}ay";

/// Returns the members of a request or reply, after the number of the call.
wire::Type numbered(const wire::Type& message, bool has_result) {
    wire::Type numbered;
    numbered.children.push_back({.kind = wire::Kind::uint64, .children = {}, .name = "call"});
    for (wire::Type& member : with_member_names(message, has_result).children)
        numbered.children.push_back(std::move(member));
    return numbered;
}

std::string text_of(const shm::FollowedCall& call) {
    if (call.status == shm::CallStatus::user_exception) {
        const auto exception = link::decode_service_exception(call.results);
        return exception.id + (exception.text.empty() ? "" : ": " + exception.text);
    }
    return {reinterpret_cast<const char*>(call.results.data()), call.results.size()};
}

} // namespace

CallWriter::Channels CallWriter::add_channels(const Key& key, shm::Side callers) {
    // Separate names, because clang does not allow lambdas to use structured bindings.
    const std::string &link = std::get<0>(key), &port = std::get<1>(key), &operation = std::get<2>(key),
                      &signature = std::get<3>(key);
    const auto types = wire::parse_operation(signature);
    const auto add = [&](const char* kind, const wire::Type& message) {
        const MessageIdl idl = message_idl(fmt::format("IDL:{}/{}_{}:1.0", port, operation, kind), message);
        return writer_.add_channel(fmt::format("/{}/{}/{}/{}", link, port, operation, kind),
                                   add_schema_(idl.name, idl.text), "cdr",
                                   {{"tandem.kind", kind},
                                    {"tandem.link", link},
                                    {"tandem.port", port},
                                    {"tandem.operation", operation},
                                    {"tandem.operation_signature", signature},
                                    {"tandem.callers", shm::name_of(callers)},
                                    {"tandem.signature", wire::to_named_signature(message)}});
    };
    return {add(request_kind, numbered(types.request, false)),
            add(reply_kind, numbered(types.reply, types.result.has_value())),
            add(failure_kind, wire::parse_signature(failure_signature))};
}

void CallWriter::write_message(std::uint16_t channel, std::uint64_t log_time, std::uint64_t publish_time,
                               std::span<const std::byte> payload) {
    // The payload's alignment is at most 8 and restarts after the 8 bytes of the number.
    message_.assign(std::begin(encapsulation), std::end(encapsulation));
    const auto number = std::as_bytes(std::span(&calls_, 1));
    message_.insert(message_.end(), number.begin(), number.end());
    message_.insert(message_.end(), payload.begin(), payload.end());
    writer_.write(channel, static_cast<std::uint32_t>(calls_), log_time, publish_time, message_);
}

bool CallWriter::write(const std::string& link, shm::Side callers, const shm::FollowedCall& call,
                       const Times& times, const std::function<bool(const std::string&)>& wanted) {
    const auto request = link::decode_request(call.arguments);
    if (!request || request->port.empty() || !wanted(std::string(request->port))) return false;
    const Key key{link, std::string(request->port), std::string(request->operation),
                  std::string(request->signature)};
    auto known = channels_.find(key);
    try {
        if (known == channels_.end()) known = channels_.emplace(key, add_channels(key, callers)).first;
    } catch (const wire::SignatureError&) { // untrusted data of another process
        return false;
    }
    ++calls_;
    write_message(known->second.request, times.log, times.call, request->arguments);
    if (call.answered && call.status == shm::CallStatus::ok) {
        write_message(known->second.reply, times.log, times.log, call.results);
        return true;
    }
    std::vector<std::byte> failure;
    wire::CdrWriter out(failure);
    out.put_string(call.answered ? shm::name_of(call.status) : "given up");
    const std::string text = call.answered ? text_of(call) : "the caller did not wait for the reply";
    out.put_string(std::string_view(text).substr(0, text.find('\0')));
    out.put_sequence(reinterpret_cast<const std::uint8_t*>(call.results.data()), call.results.size());
    write_message(known->second.failure, times.log, times.log, failure);
    return true;
}

} // namespace tandem::command
