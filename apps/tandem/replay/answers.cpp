// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/replay/answers.hpp"

#include "proxy/wire/cdr.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tandem::command {
namespace {

using Kind = RecordedChannel::Kind;

/// Decodes a message of a failure channel: `status`, `text`, `bytes`.
link::Reply failure_of(std::span<const std::byte> message) {
    wire::CdrReader in(message);
    const std::string name(in.get_string());
    in.get_string();
    const auto bytes = in.get_block(in.get_count(1), 1);
    link::Reply reply{link::CallStatus::timeout, {bytes.begin(), bytes.end()}};
    for (auto status = 0U; status <= static_cast<unsigned>(link::CallStatus::cancelled); ++status)
        if (name == shm::name_of(static_cast<link::CallStatus>(status)))
            reply.status = static_cast<link::CallStatus>(status);
    return reply;
}

} // namespace

Answers::Answers(Recording& recording) {
    while (const auto event = recording.next()) {
        const RecordedChannel& channel = *event->channel;
        if (channel.kind == Kind::message || channel.kind == Kind::step) continue;
        Call& call = calls_[event->call];
        if (channel.kind == Kind::request) {
            call.link = channel.link;
            call.port = channel.port;
            call.operation = channel.operation;
            call.signature = channel.operation_signature;
            call.callers = channel.sender;
            call.arguments.assign(event->bytes.begin(), event->bytes.end());
            continue;
        }
        call.has_reply = true;
        call.reply = channel.kind == Kind::failure
                         ? failure_of(event->bytes)
                         : link::Reply{link::CallStatus::ok, {event->bytes.begin(), event->bytes.end()}};
    }
    recording.rewind();
}

link::Reply Answers::answer(const std::string& link, const link::Request& request) {
    const std::lock_guard lock(mutex_);
    Call* found = nullptr;
    for (auto& [number, call] : calls_) {
        if (!call.has_reply || call.link != link || call.port != request.port ||
            call.operation != request.operation ||
            !std::equal(call.arguments.begin(), call.arguments.end(), request.arguments.begin(),
                        request.arguments.end()))
            continue;
        found = &call;
        if (!call.given) break;
    }
    if (found == nullptr)
        return link::Reply::failure(link::CallStatus::not_ready,
                                    fmt::format("the recording has no answer of '{}.{}' for these arguments",
                                                request.port, request.operation));
    found->given = true;
    return found->reply;
}

const link::Reply* Answers::find(std::uint64_t call) const {
    const auto found = calls_.find(call);
    return found == calls_.end() || !found->second.has_reply ? nullptr : &found->second.reply;
}

std::vector<link::ServiceOperation> Answers::operations(const std::string& link, const std::string& port,
                                                        shm::Side callers) const {
    std::vector<link::ServiceOperation> operations;
    for (const auto& [number, call] : calls_) {
        const link::ServiceOperation operation{call.operation, call.signature};
        if (call.link == link && call.port == port && call.callers == callers &&
            std::find(operations.begin(), operations.end(), operation) == operations.end())
            operations.push_back(operation);
    }
    return operations;
}

} // namespace tandem::command
