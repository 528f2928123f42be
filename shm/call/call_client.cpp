// SPDX-License-Identifier: Apache-2.0
#include "shm/call/call_client.hpp"

#include "shm/call/call_caller.hpp"
#include "shm/call/file_limit.hpp"
#include "shm/call/slot_turns.hpp"
#include "shm/os/error.hpp"
#include "shm/os/recent_clock.hpp"
#include "shm/wait/adaptive_spin.hpp"

#include <cstring>
#include <new>

namespace tandem::shm {
namespace {

// While a call waits.
constexpr std::uint64_t check_lock_every_ns = 5'000'000, check_process_every_ns = 100'000'000;

// While a call waits for a slot: the end of a call that was given up frees its slot and wakes nobody, and a caller that frees
// a slot may not have seen yet that another one waits.
constexpr std::uint64_t look_for_slot_every_ns = 1'000'000;

/// Looks, at these intervals, whether the peer of a waiting call has died. Most replies come before the first look. Looks for
/// the process only rarely: that takes ten system calls, and finds only a peer whose lock a child of clone() holds.
class PeerChecks {
  public:
    explicit PeerChecks(const Mapping& mapping) : mapping_(mapping) {}
    /// `is_due`: looks now.
    bool find_dead(std::uint64_t now, bool is_due) {
        if (now < lock_at_ && !is_due) return false;
        lock_at_ = now + check_lock_every_ns;
        if (now < process_at_) return mapping_.peer_state_by_lock() == PeerState::dead;
        process_at_ = now + check_process_every_ns;
        return mapping_.peer_state() == PeerState::dead;
    }

  private:
    const Mapping& mapping_;
    std::uint64_t lock_at_ = now_ns() + check_lock_every_ns;
    std::uint64_t process_at_ = lock_at_ - check_lock_every_ns + check_process_every_ns;
};

ReplyView fail_with(CallStatus status, const std::string& text, ResultMemory& memory) {
    const auto room = memory.room_for(text.size());
    std::memcpy(room.data(), text.data(), text.size());
    return {status, room};
}

/// A vector with the size of the results. Results of the same length overwrite the earlier ones, so that nothing is
/// cleared.
class VectorMemory final : public ResultMemory {
  public:
    explicit VectorMemory(std::vector<std::byte>& vector) : vector_(vector) {}
    ~VectorMemory() {
        if (!asked_) vector_.clear();
    }
    std::span<std::byte> room_for(std::size_t bytes) override {
        asked_ = true;
        vector_.resize(bytes);
        return vector_;
    }

  private:
    std::vector<std::byte>& vector_;
    bool asked_ = false;
};

/// A timeout of at least this length may end 1 % early, so its start may be read from RecentClock.
constexpr std::uint64_t long_timeout_ns = 100 * RecentClock::max_age_ns;

/// Data that a thread keeps between calls. One object, because each access to thread-local memory from a plugin is a
/// function call.
struct OfThread {
    std::uint32_t last_slot = 0; ///< of any queue: only a hint where to look first
    RecentClock recent_clock;
};
thread_local OfThread of_thread;

} // namespace

struct CallClient::State {
    /// Marks that the queue has a calling end. There is only one at a time, because it alone knows which slots are idle.
    class Mark {
      public:
        explicit Mark(const CallQueueHandle& handle) : word_(handle.view.header->has_client) {
            const std::string& path = handle.mapping->path();
            if (handle.callers != handle.mapping->side())
                throw Error(path + ": a call queue for callers of side " + name_of(handle.callers) +
                            " cannot be called here; use CallServer");
            if (word_.exchange(1, std::memory_order_acquire) != 0)
                throw Error(path + ": this call queue already has a CallClient; share it");
        }
        ~Mark() { word_.store(0, std::memory_order_release); }
        Mark(const Mark&) = delete;
        Mark& operator=(const Mark&) = delete;

      private:
        layout::Word32& word_;
    };

    State(const CallQueueHandle& handle, const WaitOptions& options, FindCallControl find)
        : queue(handle), how(options), max_spin_ns(bounded_ns(options.spin)), find_control(find),
          mark(handle), caller(handle.view), spins(handle.view.slot_count) {}

    ReplyView begin(std::span<const std::byte> arguments, std::chrono::nanoseconds timeout,
                    CallTicket& ticket, ResultMemory& memory);
    ReplyView begin_in_turn(std::span<const std::byte> arguments, std::uint64_t timeout_ns,
                            CallTicket& ticket, ResultMemory& memory);
    CallStart start(std::span<const std::byte> arguments, std::uint64_t timeout_ns, std::uint64_t recent,
                    CallTicket& ticket);
    ReplyView fail_to_start(CallStart start, std::uint32_t slot, std::size_t bytes,
                            ResultMemory& memory) const;
    bool is_closed() const {
        return stopped.load(std::memory_order_relaxed) ||
               queue.view.header->closed.load(std::memory_order_relaxed) != 0;
    }
    ReplyView finish(CallTicket& ticket, ResultMemory& memory);
    CallStatus await_reply(CallTicket& ticket);
    CallStatus await_late_reply(CallTicket& ticket);
    CallStatus give_up(const CallTicket& ticket, CallStatus reason);
    ReplyView take_reply(const CallTicket& ticket, ResultMemory& memory);
    ReplyView take_loan(const CallTicket& ticket, CallStatus status, std::size_t bytes, ResultMemory& memory);
    ReplyView take_damaged(const CallTicket& ticket, ResultMemory& memory);
    void measure_time(const CallTicket& ticket);

    const CallQueueHandle queue;
    const WaitOptions how;
    const std::uint64_t max_spin_ns;
    const FindCallControl find_control;
    Mark mark;
    CallCaller<RealAtomics> caller;
    SlotTurns turns;
    std::vector<AdaptiveSpin> spins;         // by slot, which is nearly by thread
    std::atomic<std::uint32_t> next_slot{0}; // with keep_history: the slot used longest ago
    std::atomic<bool> stopped{false};
    std::atomic<bool> measuring{false};
};

/// Returns ok if the call is submitted. For any other status, the bytes may hold the reason.
ReplyView CallClient::State::begin(std::span<const std::byte> arguments, std::chrono::nanoseconds timeout,
                                   CallTicket& ticket, ResultMemory& memory) {
    if (arguments.size() > queue.view.max_bytes)
        return fail_with(CallStatus::bad_arguments,
                         "arguments of " + std::to_string(arguments.size()) +
                             " bytes, the call queue takes " + std::to_string(queue.view.max_bytes),
                         memory);
    if (is_closed()) return {CallStatus::shut_down, {}};
    const std::uint64_t timeout_ns = bounded_ns(timeout);
    if (turns.any()) [[unlikely]]
        return begin_in_turn(arguments, timeout_ns, ticket, memory);
    const std::uint64_t recent = timeout_ns >= long_timeout_ns ? of_thread.recent_clock.now_ns() : 0;
    const CallStart started = start(arguments, timeout_ns, recent, ticket);
    if (started == CallStart::ok) [[likely]]
        return {CallStatus::ok, {}};
    if (started == CallStart::overload) return begin_in_turn(arguments, timeout_ns, ticket, memory);
    return fail_to_start(started, ticket.slot, arguments.size(), memory);
}

inline CallStart CallClient::State::start(std::span<const std::byte> arguments, std::uint64_t timeout_ns,
                                          std::uint64_t recent, CallTicket& ticket) {
    OfThread& thread = of_thread;
    const std::uint32_t preferred =
        how.keep_history ? next_slot.fetch_add(1, std::memory_order_relaxed) : thread.last_slot;
    // Only a caller that checks again before it sleeps may rely on a worker that is expected back.
    const bool sleeps = how.mode != WaitMode::spin;
    const CallStart started =
        caller.begin(arguments.data(), arguments.size(), timeout_ns, preferred, sleeps, ticket, recent);
    if (started == CallStart::ok) thread.last_slot = ticket.slot;
    return started;
}

ReplyView CallClient::State::fail_to_start(CallStart start, std::uint32_t slot, std::size_t bytes,
                                           ResultMemory& memory) const {
    if (start == CallStart::closed) return {CallStatus::shut_down, {}};
    if (start == CallStart::no_memory)
        return fail_with(CallStatus::overload,
                         "arguments of " + std::to_string(bytes) +
                             (exceeds_file_limit(queue.view.loans, slot, bytes)
                                  ? " bytes exceed this process's limit of file sizes; raise it (ulimit -f)"
                                  : " bytes do not fit into the free memory of /dev/shm"),
                         memory);
    queue.view.header->overloads.fetch_add(1, std::memory_order_relaxed);
    return fail_with(CallStatus::overload,
                     "none of the " + std::to_string(queue.view.slot_count) +
                         " calls under way ended before the deadline",
                     memory);
}

/// Waits for a slot after the callers that came before. The time that a CallControl allows bounds the whole call.
ReplyView CallClient::State::begin_in_turn(std::span<const std::byte> arguments, std::uint64_t timeout_ns,
                                           CallTicket& ticket, ResultMemory& memory) {
    const CallControl control = find_control ? find_control() : CallControl{};
    const std::uint64_t began = now_ns();
    const std::uint64_t bound = control.max_ns == 0 ? timeout_ns : std::min(timeout_ns, control.max_ns);
    const std::uint64_t deadline = began + bound;
    PeerChecks checks(*queue.mapping);
    SlotTurns::Turn turn(turns);
    for (bool mine = turn.has_come();;) {
        const std::uint64_t now = now_ns();
        if (checks.find_dead(now, now >= deadline)) return {CallStatus::peer_died, {}};
        if (is_closed()) return {CallStatus::shut_down, {}};
        if (control.cancelled && control.cancelled->load(std::memory_order_relaxed))
            return {CallStatus::cancelled, {}};
        if (now >= deadline) return fail_to_start(CallStart::overload, ticket.slot, arguments.size(), memory);
        if (mine) {
            const CallStart started = start(arguments, deadline - now, 0, ticket);
            ticket.begun_ns = began;
            if (started == CallStart::ok) return {CallStatus::ok, {}};
            if (started != CallStart::overload)
                return fail_to_start(started, ticket.slot, arguments.size(), memory);
        }
        const std::uint64_t step = mine ? look_for_slot_every_ns : check_lock_every_ns;
        mine = turn.wait(std::chrono::nanoseconds(std::min(step, deadline - now)));
    }
}

ReplyView CallClient::State::finish(CallTicket& ticket, ResultMemory& memory) {
    const CallStatus status = await_reply(ticket);
    if (status == CallStatus::ok) {
        const ReplyView reply = take_reply(ticket, memory);
        if (turns.any()) [[unlikely]]
            turns.wake_first();
        return reply;
    }
    auto& shared = *queue.view.header;
    if (status == CallStatus::timeout) shared.timeouts.fetch_add(1, std::memory_order_relaxed);
    if (status == CallStatus::shut_down || status == CallStatus::cancelled)
        shared.cancels.fetch_add(1, std::memory_order_relaxed);
    return {status, {}};
}

/// Returns ok if there is a reply to take. For any other status, the slot no longer belongs to this call.
CallStatus CallClient::State::await_reply(CallTicket& ticket) {
    auto& spin = spins[ticket.slot];
    const bool polls = how.mode != WaitMode::futex;
    // A short call ends within the first checks, before the clock is read.
    if (polls ? caller.spin(ticket, 0) : caller.replied(ticket)) {
        spin.learn(max_spin_ns, 0);
        return CallStatus::ok;
    }
    const std::uint64_t began = now_ns();
    if (polls && caller.spin(ticket, std::min(began + spin.limit_ns(max_spin_ns), ticket.deadline_ns))) {
        spin.learn(max_spin_ns, 0);
        return CallStatus::ok;
    }
    const CallStatus status = await_late_reply(ticket);
    if (status == CallStatus::ok) spin.learn(max_spin_ns, now_ns() - began);
    return status;
}

CallStatus CallClient::State::await_late_reply(CallTicket& ticket) {
    const CallControl control = find_control ? find_control() : CallControl{};
    const std::uint64_t deadline =
        control.max_ns == 0 ? ticket.deadline_ns : ticket.begun_ns + control.max_ns;
    PeerChecks checks(*queue.mapping);
    for (bool replied = false; !replied;) {
        const std::uint64_t now = now_ns();
        if (checks.find_dead(now, now >= deadline)) return give_up(ticket, CallStatus::peer_died);
        if (stopped.load(std::memory_order_relaxed)) return give_up(ticket, CallStatus::shut_down);
        if (control.progress)
            if (const auto share = caller.progress(ticket))
                control.progress->store(*share, std::memory_order_relaxed);
        if (control.cancelled && control.cancelled->load(std::memory_order_relaxed))
            return give_up(ticket, CallStatus::cancelled);
        if (now >= deadline) return give_up(ticket, CallStatus::timeout);
        const std::uint64_t until = std::min(now + check_lock_every_ns, deadline);
        replied = how.mode == WaitMode::spin ? caller.spin(ticket, until) : caller.sleep(ticket, until);
    }
    return CallStatus::ok;
}

/// The worker may take or answer the call at this very moment: the first to change the word decides.
CallStatus CallClient::State::give_up(const CallTicket& ticket, CallStatus reason) {
    if (reason == CallStatus::peer_died) {
        caller.forget(ticket);
        return reason;
    }
    return caller.withdraw(ticket) ? reason : CallStatus::ok;
}

ReplyView CallClient::State::take_reply(const CallTicket& ticket, ResultMemory& memory) {
    const std::uint64_t word = caller.reply(ticket);
    const auto status = static_cast<CallStatus>(tag_of(word));
    const std::uint64_t length = length_of(word);
    if (word == 0 || status > CallStatus::user_exception) return take_damaged(ticket, memory);
    if (length > queue.view.short_bytes) [[unlikely]]
        return take_loan(ticket, status, length, memory);
    const auto results = memory.room_for(length);
    caller.copy_results(ticket, results.data(), length);
    measure_time(ticket);
    caller.finish(ticket);
    return {status, results};
}

/// The length is checked against the memory that the peer has really written, before this process takes as much.
ReplyView CallClient::State::take_loan(const CallTicket& ticket, CallStatus status, std::size_t bytes,
                                       ResultMemory& memory) {
    if (bytes > queue.view.max_bytes || !caller.has_loan(ticket, bytes)) return take_damaged(ticket, memory);
    std::span<std::byte> results;
    try {
        results = memory.room_for(bytes);
    } catch (const std::bad_alloc&) { // the slot must not stay in use
        caller.finish(ticket);
        return fail_with(CallStatus::exception,
                         "results of " + std::to_string(bytes) +
                             " bytes do not fit into the free memory of this process",
                         memory);
    }
    if (!caller.copy_loan(ticket, results.data(), bytes)) return take_damaged(ticket, memory);
    measure_time(ticket);
    caller.finish(ticket);
    return {status, results};
}

/// A worker does not take the call any more, if it is still submitted.
ReplyView CallClient::State::take_damaged(const CallTicket& ticket, ResultMemory& memory) {
    caller.forget(ticket);
    return fail_with(CallStatus::exception, "the peer has damaged the reply", memory);
}

/// The histogram has one writer at a time: if another thread is writing, this time is left out.
void CallClient::State::measure_time(const CallTicket& ticket) {
    if (!is_timed(ticket.word) || measuring.exchange(true, std::memory_order_acquire)) return;
    queue.times->round_trip.add(now_ns() - ticket.begun_ns);
    measuring.store(false, std::memory_order_release);
}

CallClient::CallClient(const CallQueueHandle& queue, const WaitOptions& how, FindCallControl find_control)
    : state_(std::make_unique<State>(queue, how, find_control)) {}
CallClient::~CallClient() = default;
CallClient::CallClient(CallClient&&) noexcept = default;

Reply CallClient::call(std::span<const std::byte> arguments, std::chrono::nanoseconds timeout) {
    Reply reply{CallStatus::ok, {}};
    reply.status = call_into(arguments, timeout, reply.bytes);
    return reply;
}

ReplyView CallClient::call_into(std::span<const std::byte> arguments, std::chrono::nanoseconds timeout,
                                ResultMemory& memory) {
    CallTicket ticket;
    const ReplyView begun = state_->begin(arguments, timeout, ticket, memory);
    return begun.status == CallStatus::ok ? state_->finish(ticket, memory) : begun;
}

CallStatus CallClient::call_into(std::span<const std::byte> arguments, std::chrono::nanoseconds timeout,
                                 std::vector<std::byte>& results) {
    VectorMemory memory(results);
    return call_into(arguments, timeout, memory).status;
}

void CallClient::shut_down() { state_->stopped.store(true, std::memory_order_relaxed); }

CallCounters CallClient::counters() const { return read_counters(state_->queue.view); }

} // namespace tandem::shm
