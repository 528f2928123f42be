// SPDX-License-Identifier: Apache-2.0
#include "shm/call/incoming_call.hpp"

#include "shm/call/call_server_state.hpp"

namespace tandem::shm {

void IncomingCall::reply_not_answered() { reply(CallStatus::exception, "the call was not answered"); }

bool IncomingCall::cancelled() const { return !server_ || server_->worker.unwanted(taken_); }

void IncomingCall::set_progress(double share) {
    if (server_) server_->worker.set_progress(taken_, share);
}

void IncomingCall::reply(CallStatus status, std::span<const std::byte> bytes) {
    if (!server_) return;
    const std::uint64_t max_bytes = server_->queue.view.max_bytes;
    if (bytes.size() > max_bytes)
        return reply(status == CallStatus::ok ? CallStatus::exception : status,
                     "a result of " + std::to_string(bytes.size()) + " bytes, the call queue takes " +
                         std::to_string(max_bytes));
    server_->answer(taken_, status, bytes);
    server_.reset();
}

void IncomingCall::reply(CallStatus status, const std::string& text) {
    if (!server_) return;
    const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
    reply(status, std::span(bytes, std::min<std::size_t>(text.size(), server_->queue.view.max_bytes)));
}

} // namespace tandem::shm
