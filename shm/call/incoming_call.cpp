// SPDX-License-Identifier: Apache-2.0
#include "shm/call/incoming_call.hpp"

namespace tandem::shm {

/// Calls that must not run are answered here.
std::optional<TakenCall> IncomingCall::State::take_waiting(bool& watches) {
    for (std::uint32_t i = 0; i < queue.view.slot_count; ++i) {
        const auto call = worker.take(watches);
        if (!call) break;
        if (!call->sound) {
            answer(*call, CallStatus::bad_arguments, {});
        } else if (worker.closed()) {
            answer(*call, CallStatus::shut_down, {});
        } else if (call->taken_ns >= call->deadline_ns) {
            queue.view.header->expired.fetch_add(1, std::memory_order_relaxed);
            answer(*call, CallStatus::timeout, {});
        } else {
            return call;
        }
    }
    return std::nullopt;
}

std::optional<TakenCall> IncomingCall::State::take(std::chrono::nanoseconds bound) {
    const std::uint64_t began = now_ns(), deadline = began + bounded_ns(bound);
    const std::uint64_t spin_end = std::min(deadline, began + spin.limit_ns(spin_ns));
    std::uint64_t now = began; // not read anew for a call that was found by polling: only learn() uses it
    for (bool watches = false, polled = false;;) {
        auto call = take_waiting(watches);
        if (call || worker.interrupted() || now >= deadline) {
            if (watches) worker.stop_watching();
            // A short bound that passed without a call says nothing.
            if (polled && (call || now - began > spin_ns)) spin.learn(spin_ns, now - began);
            return call;
        }
        if (how.mode == WaitMode::spin) {
            if (worker.spin(deadline)) continue;
        } else {
            watches = watches || (how.mode == WaitMode::spin_then_futex && worker.watch());
            polled = polled || watches;
            if (watches && worker.spin(spin_end)) continue;
            if (watches) worker.stop_watching();
            watches = false;
            worker.sleep(deadline);
        }
        now = now_ns();
    }
}

void IncomingCall::State::answer(const TakenCall& call, CallStatus status, std::span<const std::byte> bytes) {
    // One thread at a time writes the histogram; who finds another one at it leaves its time out.
    if (is_timed(call.word) && !timing.exchange(true, std::memory_order_acquire)) {
        queue.times->service.add(now_ns() - call.taken_ns);
        timing.store(false, std::memory_order_release);
    }
    if (worker.answer(call, static_cast<std::uint32_t>(status), bytes.data(), bytes.size()))
        queue.view.header->caller_wakes.fetch_add(1, std::memory_order_relaxed);
}

IncomingCall::~IncomingCall() {
    if (server_) reply(CallStatus::exception, "the call was not answered");
}

bool IncomingCall::cancelled() const { return !server_ || server_->worker.cancelled(taken_); }

void IncomingCall::reply(CallStatus status, std::span<const std::byte> bytes) {
    if (!server_) return;
    const std::uint64_t longest = server_->queue.view.max_bytes;
    if (bytes.size() > longest)
        return reply(status == CallStatus::ok ? CallStatus::exception : status,
                     "a result of " + std::to_string(bytes.size()) + " bytes, the call queue takes " +
                         std::to_string(longest));
    server_->answer(taken_, status, bytes);
    server_.reset();
}

void IncomingCall::reply(CallStatus status, const std::string& text) {
    if (!server_) return;
    const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
    reply(status, std::span(bytes, std::min<std::size_t>(text.size(), server_->queue.view.max_bytes)));
}

} // namespace tandem::shm
