// SPDX-License-Identifier: Apache-2.0
#include "shm/call/call_client.hpp"

#include "shm/call/call_caller.hpp"
#include "shm/os/error.hpp"
#include "shm/os/recent_clock.hpp"
#include "shm/wait/adaptive_spin.hpp"

namespace tandem::shm {
namespace {

constexpr std::uint64_t look_after_peer_ns = 5'000'000;

CallStatus say(CallStatus status, const std::string& text, std::vector<std::byte>& results) {
    const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
    results.assign(bytes, bytes + text.size());
    return status;
}

/// The slot this thread had last, in whichever queue: only a hint where to look first.
thread_local std::uint32_t last_slot = 0;

/// A bound of this length may pass 1 % early.
constexpr std::uint64_t long_bound_ns = 100 * RecentClock::oldest_ns;
thread_local RecentClock recent_clock;

} // namespace

struct CallClient::State {
    State(const CallQueueHandle& handle, const WaitOptions& options)
        : queue(handle), how(options), spin_ns(bounded_ns(options.spin)), calling(handle),
          caller(handle.view), spins(handle.view.slot_count) {}

    /// The calling end of the queue, for one State at a time: it alone knows which slots are idle.
    struct Calling {
        explicit Calling(const CallQueueHandle& handle) : word(handle.view.header->calling) {
            const std::string& path = handle.mapping->path();
            if (handle.callers != handle.mapping->side())
                throw Error(path + ": a call queue for callers of side " + name_of(handle.callers) +
                            " cannot be called here; use CallServer");
            if (word.exchange(1, std::memory_order_acquire) != 0)
                throw Error(path + ": this call queue has a CallClient already; share that one");
        }
        ~Calling() { word.store(0, std::memory_order_release); }
        Calling(const Calling&) = delete;
        Calling& operator=(const Calling&) = delete;
        layout::Word32& word;
    };

    CallStatus begin(std::uint32_t operation, std::span<const std::byte> arguments,
                     std::chrono::nanoseconds timeout, bool waits, CallTicket& ticket,
                     std::vector<std::byte>& text);
    CallStatus finish(CallTicket& ticket, std::vector<std::byte>& results);
    CallStatus await(CallTicket& ticket);
    CallStatus give_up(const CallTicket& ticket, CallStatus reason);
    CallStatus collect(const CallTicket& ticket, std::vector<std::byte>& results);
    void take_time(const CallTicket& ticket);

    const CallQueueHandle queue;
    const WaitOptions how;
    const std::uint64_t spin_ns;
    Calling calling;
    CallCaller<RealAtomics> caller;
    std::vector<AdaptiveSpin> spins; // by slot, which is nearly by thread
    std::atomic<bool> stopped{false};
    std::atomic<bool> timing{false};
};

/// ok: submitted. Anything else: `text` says why, if there is more to say.
CallStatus CallClient::State::begin(std::uint32_t operation, std::span<const std::byte> arguments,
                                    std::chrono::nanoseconds timeout, bool waits, CallTicket& ticket,
                                    std::vector<std::byte>& text) {
    text.clear();
    if (arguments.size() > queue.view.max_bytes)
        return say(CallStatus::bad_arguments,
                   "arguments of " + std::to_string(arguments.size()) + " bytes, the call queue takes " +
                       std::to_string(queue.view.max_bytes),
                   text);
    auto& shared = *queue.view.header;
    if (stopped.load(std::memory_order_relaxed) || shared.closed.load(std::memory_order_relaxed) != 0)
        return CallStatus::shut_down;
    const std::uint64_t bound = bounded_ns(timeout);
    const std::uint64_t recent = bound >= long_bound_ns ? recent_clock.now_ns() : 0;
    switch (caller.begin(operation, arguments.data(), arguments.size(), bound, last_slot, waits, ticket,
                         recent)) {
    case CallStart::ok:
        last_slot = ticket.slot;
        return CallStatus::ok;
    case CallStart::closed:
        return CallStatus::shut_down;
    case CallStart::overload:
        break;
    }
    shared.overloads.fetch_add(1, std::memory_order_relaxed);
    return CallStatus::overload;
}

CallStatus CallClient::State::finish(CallTicket& ticket, std::vector<std::byte>& results) {
    const CallStatus status = await(ticket);
    if (status == CallStatus::ok) return collect(ticket, results);
    auto& shared = *queue.view.header;
    if (status == CallStatus::timeout) shared.timeouts.fetch_add(1, std::memory_order_relaxed);
    if (status == CallStatus::cancelled || status == CallStatus::shut_down)
        shared.cancels.fetch_add(1, std::memory_order_relaxed);
    results.clear();
    return status;
}

/// ok: there is a reply to collect. Anything else: the slot is no longer this call's.
CallStatus CallClient::State::await(CallTicket& ticket) {
    auto& spin = spins[ticket.slot];
    const std::uint64_t deadline = ticket.deadline_ns;
    const bool polls = how.mode != WaitMode::futex;
    // A short call ends within the first looks, before anybody has asked for the time.
    bool over = polls ? caller.spin(ticket, 0) : caller.over(ticket);
    std::uint64_t now = over ? 0 : now_ns();
    const std::uint64_t began = now;
    if (!over && polls) over = caller.spin(ticket, std::min(now + spin.limit_ns(spin_ns), deadline));
    if (over && caller.replied(ticket)) {
        spin.learn(spin_ns, 0);
        return CallStatus::ok;
    }
    while (!over) {
        now = now_ns();
        if (queue.mapping->peer() == PeerState::dead) return give_up(ticket, CallStatus::peer_died);
        if (stopped.load(std::memory_order_relaxed)) return give_up(ticket, CallStatus::shut_down);
        if (now >= deadline) return give_up(ticket, CallStatus::timeout);
        const std::uint64_t slice = std::min(now + look_after_peer_ns, deadline);
        over = how.mode == WaitMode::spin ? caller.spin(ticket, slice) : caller.sleep(ticket, slice);
    }
    if (began != 0) spin.learn(spin_ns, now_ns() - began);
    return caller.replied(ticket) ? CallStatus::ok : give_up(ticket, CallStatus::cancelled);
}

/// The worker may take or answer the call at this very moment: whoever changes the word first decides.
CallStatus CallClient::State::give_up(const CallTicket& ticket, CallStatus reason) {
    if (reason == CallStatus::peer_died) {
        caller.forget(ticket);
        return reason;
    }
    return caller.withdraw(ticket) ? reason : CallStatus::ok;
}

CallStatus CallClient::State::collect(const CallTicket& ticket, std::vector<std::byte>& results) {
    const std::uint64_t word = caller.reply(ticket);
    const auto status = static_cast<CallStatus>(tag_of(word));
    const std::uint64_t length = length_of(word);
    if (word == 0 || status > CallStatus::cancelled || length > queue.view.max_bytes) {
        caller.forget(ticket); // whatever stands there, it is not submitted any more
        return say(CallStatus::exception, "the other side has damaged the reply", results);
    }
    results.resize(length);
    caller.copy_results(ticket, results.data(), length);
    take_time(ticket);
    caller.done(ticket);
    return status;
}

/// One thread at a time writes the histogram; who finds another one at it leaves its time out.
void CallClient::State::take_time(const CallTicket& ticket) {
    if (!is_timed(ticket.word) || timing.exchange(true, std::memory_order_acquire)) return;
    queue.times->round_trip.add(now_ns() - ticket.begun_ns);
    timing.store(false, std::memory_order_release);
}

CallClient::CallClient(const CallQueueHandle& queue, const WaitOptions& how)
    : state_(std::make_shared<State>(queue, how)) {}

Reply CallClient::call(std::uint32_t operation, std::span<const std::byte> arguments,
                       std::chrono::nanoseconds timeout) {
    Reply reply{CallStatus::ok, {}};
    reply.status = call_into(operation, arguments, timeout, reply.bytes);
    return reply;
}

CallStatus CallClient::call_into(std::uint32_t operation, std::span<const std::byte> arguments,
                                 std::chrono::nanoseconds timeout, std::vector<std::byte>& results) {
    // Only who looks again before it sleeps may rely on a worker that is expected back.
    const bool sleeps = state_->how.mode != WaitMode::spin;
    CallTicket ticket;
    const CallStatus begun = state_->begin(operation, arguments, timeout, sleeps, ticket, results);
    return begun == CallStatus::ok ? state_->finish(ticket, results) : begun;
}

PendingCall CallClient::begin(std::uint32_t operation, std::span<const std::byte> arguments,
                              std::chrono::nanoseconds timeout) {
    PendingCall call(state_);
    call.refused_ = state_->begin(operation, arguments, timeout, false, call.ticket_, call.reason_);
    return call;
}

void CallClient::shut_down() { state_->stopped.store(true, std::memory_order_relaxed); }

CallCounters CallClient::counters() const { return read_counters(state_->queue.view); }

void CancelToken::cancel() const {
    if (const auto client = client_.lock()) client->caller.cancel(ticket_);
}

PendingCall::~PendingCall() {
    if (!client_ || refused_ != CallStatus::ok) return;
    if (client_->give_up(ticket_, CallStatus::cancelled) == CallStatus::cancelled)
        client_->queue.view.header->cancels.fetch_add(1, std::memory_order_relaxed);
    else
        client_->caller.done(ticket_);
}

bool PendingCall::ready() const {
    return !client_ || refused_ != CallStatus::ok || client_->caller.over(ticket_);
}

CallStatus PendingCall::wait_into(std::vector<std::byte>& results) {
    const auto client = std::move(client_);
    if (!client) return say(CallStatus::cancelled, "this call has been waited for already", results);
    if (refused_ != CallStatus::ok) {
        results = reason_;
        return refused_;
    }
    return client->finish(ticket_, results);
}

Reply PendingCall::wait() {
    Reply reply{CallStatus::ok, {}};
    reply.status = wait_into(reply.bytes);
    return reply;
}

void PendingCall::cancel() { token().cancel(); }

CancelToken PendingCall::token() const {
    CancelToken token;
    if (refused_ == CallStatus::ok) token.client_ = client_;
    token.ticket_ = ticket_;
    return token;
}

} // namespace tandem::shm
