// SPDX-License-Identifier: Apache-2.0
#include "shm/call/call_server_state.hpp"

#include "shm/call/file_limit.hpp"

#include <string_view>

namespace tandem::shm {

namespace {

/// Reads the clock only where it matters, because reading it takes a tenth of a short call.
bool in_time(TakenCall& call, RecentClock& clock) {
    if (!is_timed(call.word) && clock.now_ns() + RecentClock::max_age_ns < call.deadline_ns) [[likely]]
        return true;
    call.taken_ns = now_ns();
    return call.taken_ns < call.deadline_ns;
}

} // namespace

bool IncomingCall::State::take_runnable(bool& polling, RecentClock& clock, TakenCall& call) {
    for (std::uint32_t i = 0; i < queue.view.slot_count; ++i) {
        if (!worker.take(polling, call)) break;
        if (in_time(call, clock) && call.valid && !worker.closed()) [[likely]]
            return true;
        refuse(call);
    }
    return false;
}

void IncomingCall::State::refuse(const TakenCall& call) {
    if (!call.valid) return answer(call, CallStatus::bad_arguments, {});
    if (worker.closed()) return answer(call, CallStatus::shut_down, {});
    queue.view.header->expired.fetch_add(1, std::memory_order_relaxed);
    answer(call, CallStatus::timeout, {});
}

/// The caller that has given up would not give a loan back.
void IncomingCall::State::prepare_results(const TakenCall& call, CallStatus& status,
                                          std::span<const std::byte>& bytes) {
    if (worker.given_up(call)) bytes = {};
    if (bytes.size() <= CallView::result_room || worker.prepare_results(call, bytes.data(), bytes.size()))
        return;
    constexpr std::string_view no_memory = "the results do not fit into the free memory of /dev/shm",
                               limited = "the results exceed the limit of file sizes of the process that "
                                         "executes the call; raise it (ulimit -f)";
    const bool exceeds_limit = exceeds_file_limit(queue.view.loans, call.slot, bytes.size());
    status = CallStatus::exception;
    bytes = std::as_bytes(std::span(exceeds_limit ? limited : no_memory));
}

bool IncomingCall::State::take(std::chrono::nanoseconds bound, TakenCall& call) {
    RecentClock clock;
    const std::uint64_t began = clock.now_ns(), deadline = began + bounded_ns(bound);
    const std::uint64_t spin_end = std::min(deadline, began + spin.limit_ns(max_spin_ns));
    for (bool polling = false, polled = false, waited = false, slept = false;;) {
        const bool taken = take_runnable(polling, clock, call);
        // For a call that polling found, no time counts as passed.
        const bool time_passed = taken ? slept : waited;
        const std::uint64_t now = time_passed ? now_ns() : began;
        if (taken || worker.waits_ended() || now >= deadline) {
            if (polling) worker.stop_polling();
            // A short bound that passed without a call teaches nothing.
            if (polled && (taken || now - began > max_spin_ns)) spin.learn(max_spin_ns, now - began);
            return taken;
        }
        waited = true;
        if (how.mode == WaitMode::spin) {
            if (worker.spin(deadline)) continue;
        } else {
            polling = polling || (how.mode == WaitMode::spin_then_futex && worker.try_become_poller());
            polled = polled || polling;
            if (polling && worker.spin(spin_end)) continue;
            if (polling) worker.stop_polling();
            polling = false;
            worker.sleep(deadline);
            slept = true;
        }
    }
}

void IncomingCall::State::answer(const TakenCall& call, CallStatus status, std::span<const std::byte> bytes) {
    // The histogram has one writer at a time: if another thread is writing, this time is left out.
    if (is_timed(call.word) && !measuring.exchange(true, std::memory_order_acquire)) {
        queue.times->service.add(now_ns() - call.taken_ns);
        measuring.store(false, std::memory_order_release);
    }
    if (bytes.size() > CallView::result_room) [[unlikely]]
        prepare_results(call, status, bytes);
    if (worker.answer(call, status, bytes.data(), bytes.size()))
        queue.view.header->caller_wakes.fetch_add(1, std::memory_order_relaxed);
}

} // namespace tandem::shm
