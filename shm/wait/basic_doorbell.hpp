// SPDX-License-Identifier: Apache-2.0
// Internal to Doorbell: what both sides do with its words. A template over the atomics policy, so that tests/shm/model runs
// the shipping code.
#pragma once
#include "shm/os/bounded_sleep.hpp"
#include "shm/os/tick_length.hpp"
#include "shm/wait/adaptive_spin.hpp"
#include "shm/wait/ready_bits.hpp"
#include "shm/wait/spin_until.hpp"
#include "shm/wait/wait_options.hpp"

namespace tandem::shm {

/// The doorbell of one side, its owner. The owner waits. The peer, and threads of the owner's process, ring.
template <class A>
class BasicDoorbell {
  public:
    static constexpr unsigned user_bits = ReadyBits::size - 2; ///< bits 0 .. user_bits - 1 are the user's
    static constexpr unsigned attention_bit =
        user_bits; ///< the peer joined, published or left: check Segment
    static constexpr unsigned interrupt_bit = attention_bit + 1; ///< interrupt() was called

    explicit BasicDoorbell(layout::BasicDoorbellWords<A>& words) : words_(words) {}

    /// [any-thread] Sets one bit, or several bits, and wakes the owner once if it is asleep. Call it after publishing the
    /// data. ring() returns true if the owner was asleep.
    bool ring(unsigned bit);
    void ring_all(const ReadyBits& bits);

    /// [one thread] For many ports: takes the bits rung so far, or waits at most `bound` for the first bit. Returns an empty
    /// set if no bit came. A set bit means that its port may have data. The first call after wait_for() sets all user bits.
    ReadyBits wait(std::chrono::nanoseconds bound, const WaitOptions& how = {});
    ReadyBits poll(); ///< Takes the bits rung so far.

    /// [one thread] For few ports: waits at most `bound` until ready() holds, or attention_bit or interrupt_bit is rung.
    /// Returns only these two bits. ready() checks the rings (RingReader::empty()) and is called often. From this call
    /// until the next wait() or poll(), the peer rings user bits only to wake the owner.
    template <class Ready>
    ReadyBits wait_for(Ready&& ready, std::chrono::nanoseconds bound, const WaitOptions& how = {});

    /// [any-thread] Ends the owner's current wait, or the next one, with interrupt_bit.
    void interrupt();

    /// Returns the number of system calls that this object made to wake a sleeper.
    std::uint64_t wakes() const { return wakes_.load(std::memory_order_relaxed); }

  private:
    using Owner = layout::DoorbellOwner;
    using Word32 = typename A::template Atomic<std::uint32_t>;

    void announce(Owner state);
    void set(unsigned bit);
    bool wake_owner();
    ReadyBits take_all();
    ReadyBits take_reserved();
    bool any_rung() const {
        std::uint64_t all = 0;
        for (const auto& word : words_.ready) all |= word.load(std::memory_order_relaxed);
        return all != 0;
    }
    template <class Done>
    bool wait_until_done(Done&& done, std::chrono::nanoseconds bound, const WaitOptions& how,
                         Owner afterwards);
    template <class Done>
    bool sleep_until_done(Done&& done, std::chrono::nanoseconds bound, Owner afterwards);

    layout::BasicDoorbellWords<A>& words_;
    AdaptiveSpin spin_;
    Owner own_state_ = Owner::awake; // private copy, valid in the owner only
    Word32 last_seen_owner_{0};      // the owner's word as a ringer of this object last saw it
    std::atomic<std::uint64_t> wakes_{0};
};

template <class A>
void BasicDoorbell<A>::announce(Owner state) {
    own_state_ = state;
    words_.owner.store(static_cast<std::uint32_t>(state), std::memory_order_relaxed);
    A::fence(); // before the checks of bits and rings, whose loads are weaker than seq_cst
}

template <class A>
bool BasicDoorbell<A>::ring(unsigned bit) {
    // An owner that polled last time probably still polls. Then its line is only read and not acquired for writing.
    constexpr auto polling = static_cast<std::uint32_t>(Owner::polling);
    if (bit < user_bits && last_seen_owner_.load(std::memory_order_relaxed) == polling) {
        A::fence(); // after the data, whose stores are only release
        if (words_.owner.load(std::memory_order_relaxed) == polling) return false;
    }
    __builtin_prefetch(&words_, 1); // while the data's stores are still on their way to the cache
    set(bit);
    return wake_owner();
}

/// Always performs a read-modify-write, even if the bit is already set, because it orders the data before the load of the
/// owner's word. Without it the owner could take the old bit, miss the data, and sleep.
template <class A>
void BasicDoorbell<A>::set(unsigned bit) {
    words_.ready[bit / 64 % layout::doorbell_words].fetch_or(std::uint64_t{1} << (bit % 64),
                                                             std::memory_order_seq_cst);
}

/// Makes the system call even if the owner does not seem asleep: an earlier ringer that found it asleep may have been killed
/// before its system call.
template <class A>
void BasicDoorbell<A>::interrupt() {
    set(interrupt_bit);
    if (!wake_owner()) A::futex_wake(words_.owner, 1);
}

template <class A>
void BasicDoorbell<A>::ring_all(const ReadyBits& bits) {
    for (std::size_t i = 0; i < bits.words.size(); ++i)
        if (bits.words[i] != 0) words_.ready[i].fetch_or(bits.words[i], std::memory_order_seq_cst);
    wake_owner();
}

/// Returns true if it made a system call.
template <class A>
bool BasicDoorbell<A>::wake_owner() {
    constexpr auto asleep = static_cast<std::uint32_t>(Owner::asleep);
    constexpr auto awake = static_cast<std::uint32_t>(Owner::awake);
    std::uint32_t owner = words_.owner.load(std::memory_order_seq_cst);
    if (last_seen_owner_.load(std::memory_order_relaxed) != owner)
        last_seen_owner_.store(owner, std::memory_order_relaxed);
    // If several ringers try this, only the one that changes the word makes the system call.
    if (owner != asleep || !words_.owner.compare_exchange_strong(owner, awake, std::memory_order_seq_cst))
        return false;
    A::futex_wake(words_.owner, 1);
    wakes_.fetch_add(1, std::memory_order_relaxed);
    return true;
}

template <class A>
ReadyBits BasicDoorbell<A>::take_all() {
    ReadyBits bits;
    for (std::size_t i = 0; i < bits.words.size(); ++i)
        if (words_.ready[i].load(std::memory_order_relaxed) != 0)
            bits.words[i] = words_.ready[i].exchange(0, std::memory_order_acquire);
    return bits;
}

/// Takes all bits and returns only attention and interrupt: the owner checks the user's ports anyway.
template <class A>
ReadyBits BasicDoorbell<A>::take_reserved() {
    const ReadyBits bits = take_all();
    ReadyBits reserved;
    for (const unsigned bit : {attention_bit, interrupt_bit})
        if (bits.test(bit)) reserved.set(bit);
    return reserved;
}

template <class A>
ReadyBits BasicDoorbell<A>::poll() {
    if (own_state_ == Owner::awake) return any_rung() ? take_all() : ReadyBits{};
    // While the owner polled its rings, no bits were rung for them: any port may have data.
    announce(Owner::awake);
    ReadyBits bits = take_all();
    for (unsigned bit = 0; bit < user_bits; ++bit) bits.set(bit);
    return bits;
}

template <class A>
ReadyBits BasicDoorbell<A>::wait(std::chrono::nanoseconds bound, const WaitOptions& how) {
    const ReadyBits bits = poll();
    if (bits.any()) return bits;
    return wait_until_done([&] { return any_rung(); }, bound, how, Owner::awake) ? take_all() : ReadyBits{};
}

/// Polls, then sleeps, according to the mode. `afterwards` is the owner's state on return.
template <class A>
template <class Done>
bool BasicDoorbell<A>::wait_until_done(Done&& done, std::chrono::nanoseconds bound, const WaitOptions& how,
                                       Owner afterwards) {
    if (how.mode == WaitMode::futex) return sleep_until_done(done, bound, afterwards);
    const std::uint64_t start = A::now(), start_ticks = A::ticks();
    const std::uint64_t deadline = start + bounded_ns(bound);
    if (how.mode == WaitMode::spin) return spin_until<A>(deadline, done);
    const auto max_spin_ns = static_cast<std::uint64_t>(how.spin.count());
    const std::uint64_t spin_end = std::min(deadline, start + spin_.limit_ns(max_spin_ns));
    if (how.mode == WaitMode::same_core ? yield_until<A>(spin_end, done) : spin_until<A>(spin_end, done)) {
        spin_.learn(max_spin_ns, 0);
        return true;
    }
    const std::uint64_t now = A::now();
    const TickLength tick(now - start, A::ticks() - start_ticks);
    const bool found =
        sleep_until_done(done, std::chrono::nanoseconds(deadline - std::min(deadline, now)), afterwards);
    // Uses ticks, because reading the clock would delay an owner that was just woken.
    spin_.learn(max_spin_ns, tick.ns(A::ticks() - start_ticks));
    return found;
}

// The order is that of sleep_until.hpp: the owner stores its state, a ringer stores its data, and then each loads the other's
// word. Either done() holds at once, or the ringer sets the bit and wakes the owner if it is asleep.
template <class A>
template <class Done>
bool BasicDoorbell<A>::sleep_until_done(Done&& done, std::chrono::nanoseconds bound, Owner afterwards) {
    typename A::BoundedSleep sleep(bound);
    bool found = false;
    do {
        announce(Owner::asleep);
        found = done();
        if (found || !sleep.sleep_while(words_.owner, static_cast<std::uint32_t>(Owner::asleep))) break;
        found = done();
    } while (!found);
    own_state_ = afterwards;
    words_.owner.store(static_cast<std::uint32_t>(afterwards), std::memory_order_relaxed);
    return found || done();
}

/// Calls ready() before it checks the bits: an owner that a message has woken reads this message first. It takes the bit of
/// this message in the next wait, when the transfer of the doorbell's line delays no message.
template <class A>
template <class Ready>
ReadyBits BasicDoorbell<A>::wait_for(Ready&& ready, std::chrono::nanoseconds bound, const WaitOptions& how) {
    if (any_rung()) {
        const ReadyBits reserved = take_reserved();
        if (reserved.any()) return reserved;
    }
    if (ready()) return {};
    if (own_state_ != Owner::polling) announce(Owner::polling);
    wait_until_done([&] { return ready() || any_rung(); }, bound, how, Owner::polling);
    return ready() || !any_rung() ? ReadyBits{} : take_reserved();
}

} // namespace tandem::shm
