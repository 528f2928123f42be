// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/adaptive_spin.hpp"
#include "shm/futex.hpp"
#include "shm/mapping.hpp"
#include "shm/ready_bits.hpp"

#include <memory>

namespace tandem::shm {

/// One bell per side, however many ports: ready bits and a futex word, all in one line. Whoever has published
/// data rings a bit at the other side's bell, after the data, once per batch. That makes a system call only
/// if the owner sleeps, and does not even write while the owner looks at its rings itself (wait_for).
class Doorbell {
  public:
    static constexpr unsigned user_bits = ReadyBits::size - 2; ///< the user's: 0 .. user_bits - 1
    static constexpr unsigned attention_bit = user_bits; ///< peer joined, published or left: look at Segment
    static constexpr unsigned interrupt_bit = attention_bit + 1; ///< interrupt() was called

    Doorbell(std::shared_ptr<const Mapping> mapping, Side owner);

    /// [any-thread] Sets one bit, or several, and wakes the owner once if it sleeps.
    void ring(unsigned bit);
    void ring_all(const ReadyBits& bits);

    /// [one thread] For many ports: takes the bits rung so far; waits for the first at most `bound`. Empty:
    /// none came. A set bit says "look there"; after wait_for() all of the user's are set once.
    ReadyBits wait(std::chrono::nanoseconds bound, const WaitOptions& how = {});
    ReadyBits poll();

    /// [one thread] For few ports: waits until ready() holds, at most `bound`, or attention or interrupt was
    /// rung: these two bits come back. ready() looks at the rings (RingReader::empty()) and is called often;
    /// from here until the next wait() or poll() the other side rings no user bit but to wake.
    template <class Ready>
    ReadyBits wait_for(Ready&& ready, std::chrono::nanoseconds bound, const WaitOptions& how = {});

    /// [any-thread] Ends the owner's wait, now or the next, with interrupt_bit.
    void interrupt() { ring(interrupt_bit); }

    /// System calls this object has made to wake a sleeper.
    std::uint64_t wakes() const { return wakes_.load(std::memory_order_relaxed); }

  private:
    using Owner = layout::DoorbellOwner;

    void become(Owner state);
    void wake_owner();
    ReadyBits take();
    bool rung() const {
        std::uint64_t all = 0;
        for (const auto& word : words_.ready) all |= word.load(std::memory_order_relaxed);
        return all != 0;
    }
    template <class Done>
    bool wait_until_done(Done&& done, std::chrono::nanoseconds bound, const WaitOptions& how, Owner awake);

    std::shared_ptr<const Mapping> mapping_;
    layout::DoorbellWords& words_;
    AdaptiveSpin spin_;
    Owner owner_ = Owner::listens;       // my own copy, if this side is the owner
    std::atomic<std::uint32_t> seen_{0}; // the owner's word as a ringer saw it last
    std::atomic<std::uint64_t> wakes_{0};
};

// The owner's word and the data are two sides' words crossing (as in futex.hpp):
//
//     owner: word = sleeps or listens | fence | done()?        ringer: data | fence | word == looks?
//
// At least one of the two sees the other: either done() holds at once, or the ringer sets the bit and, if the
// owner sleeps, wakes it.
template <class Done>
bool Doorbell::wait_until_done(Done&& done, std::chrono::nanoseconds bound, const WaitOptions& how,
                               Owner awake) {
    const auto longest = static_cast<std::uint64_t>(how.spin.count());
    if (how.mode != WaitMode::futex) {
        const std::uint64_t start = now_ns();
        const std::uint64_t deadline =
            start + static_cast<std::uint64_t>(std::clamp(bound, {}, longest_wait).count());
        if (how.mode == WaitMode::spin) return spin_until(deadline, done);
        const std::uint64_t enough = std::min(deadline, start + spin_.limit_ns(longest));
        if (how.mode == WaitMode::same_core ? yield_until(enough, done) : spin_until(enough, done)) {
            spin_.learn(longest, now_ns() - start);
            return true;
        }
        bound = std::chrono::nanoseconds(deadline - std::min(deadline, now_ns()));
        const bool found = wait_until_done(done, bound, {WaitMode::futex}, awake);
        spin_.learn(longest, now_ns() - start);
        return found;
    }
    BoundedSleep sleep(bound);
    bool found = false;
    do {
        become(Owner::sleeps);
        found = done();
        if (found || !sleep.on(words_.owner, static_cast<std::uint32_t>(Owner::sleeps))) break;
        found = done();
    } while (!found);
    owner_ = awake;
    words_.owner.store(static_cast<std::uint32_t>(awake), std::memory_order_relaxed);
    return found || done();
}

template <class Ready>
ReadyBits Doorbell::wait_for(Ready&& ready, std::chrono::nanoseconds bound, const WaitOptions& how) {
    if (!rung() && ready()) return {};
    if (owner_ != Owner::looks) become(Owner::looks);
    wait_until_done([&] { return rung() || ready(); }, bound, how, Owner::looks);
    if (!rung()) return {};
    const ReadyBits bits = take();
    ReadyBits own;
    for (const unsigned bit : {attention_bit, interrupt_bit})
        if (bits.test(bit)) own.set(bit);
    return own;
}

} // namespace tandem::shm
