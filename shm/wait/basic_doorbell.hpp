// SPDX-License-Identifier: Apache-2.0
// Inside of Doorbell: what both sides do with its words; a template over the atomics policy, so that what
// ships is what tests/shm/model runs.
#pragma once
#include "shm/os/futex.hpp"
#include "shm/wait/adaptive_spin.hpp"
#include "shm/wait/ready_bits.hpp"

namespace tandem::shm {

template <class A>
class BasicDoorbell {
  public:
    static constexpr unsigned user_bits = ReadyBits::size - 2; ///< the user's: 0 .. user_bits - 1
    static constexpr unsigned attention_bit = user_bits; ///< peer joined, published or left: look at Segment
    static constexpr unsigned interrupt_bit = attention_bit + 1; ///< interrupt() was called

    explicit BasicDoorbell(layout::BasicDoorbellWords<A>& words) : words_(words) {}

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
    void interrupt();

    /// System calls this object has made to wake a sleeper.
    std::uint64_t wakes() const { return wakes_.load(std::memory_order_relaxed); }

  private:
    using Owner = layout::DoorbellOwner;
    using Word32 = typename A::template Atomic<std::uint32_t>;

    void become(Owner state);
    void set(unsigned bit);
    bool wake_owner();
    ReadyBits take();
    ReadyBits take_own();
    bool rung() const {
        std::uint64_t all = 0;
        for (const auto& word : words_.ready) all |= word.load(std::memory_order_relaxed);
        return all != 0;
    }
    template <class Done>
    bool wait_until_done(Done&& done, std::chrono::nanoseconds bound, const WaitOptions& how, Owner awake);

    layout::BasicDoorbellWords<A>& words_;
    AdaptiveSpin spin_;
    Owner owner_ = Owner::listens; // my own copy, if this side is the owner
    Word32 seen_{0};               // the owner's word as a ringer saw it last
    std::atomic<std::uint64_t> wakes_{0};
};

template <class A>
void BasicDoorbell<A>::become(Owner state) {
    owner_ = state;
    words_.owner.store(static_cast<std::uint32_t>(state), std::memory_order_relaxed);
    A::fence(); // before the look at the bits and the rings, whose loads are weaker
}

template <class A>
void BasicDoorbell<A>::ring(unsigned bit) {
    // An owner that looked last time most likely still does, and then its line is only read. Otherwise the
    // line has to be written, and comes with the write.
    constexpr auto looks = static_cast<std::uint32_t>(Owner::looks);
    if (bit < user_bits && seen_.load(std::memory_order_relaxed) == looks) {
        A::fence(); // after the data, whose stores are only release
        if (words_.owner.load(std::memory_order_relaxed) == looks) return;
    }
    __builtin_prefetch(&words_, 1); // while the data's stores still leave the core
    set(bit);
    wake_owner();
}

/// Always a read-modify-write, even if the bit is set already: it stands between the data and the look at the
/// owner's word. Skipping it would let the owner take the old bit, miss the data, and sleep.
template <class A>
void BasicDoorbell<A>::set(unsigned bit) {
    words_.ready[bit / 64 % layout::doorbell_words].fetch_or(std::uint64_t{1} << (bit % 64),
                                                             std::memory_order_seq_cst);
}

/// The call is made in any case: whoever has found the owner asleep before may have been killed before its
/// own.
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

/// True: that took a system call.
template <class A>
bool BasicDoorbell<A>::wake_owner() {
    constexpr auto sleeps = static_cast<std::uint32_t>(Owner::sleeps);
    constexpr auto listens = static_cast<std::uint32_t>(Owner::listens);
    std::uint32_t owner = words_.owner.load(std::memory_order_seq_cst);
    if (seen_.load(std::memory_order_relaxed) != owner) seen_.store(owner, std::memory_order_relaxed);
    // One of several ringers makes the call.
    if (owner != sleeps || !words_.owner.compare_exchange_strong(owner, listens, std::memory_order_seq_cst))
        return false;
    A::futex_wake(words_.owner, 1);
    wakes_.fetch_add(1, std::memory_order_relaxed);
    return true;
}

template <class A>
ReadyBits BasicDoorbell<A>::take() {
    ReadyBits bits;
    for (std::size_t i = 0; i < bits.words.size(); ++i)
        if (words_.ready[i].load(std::memory_order_relaxed) != 0)
            bits.words[i] = words_.ready[i].exchange(0, std::memory_order_acquire);
    return bits;
}

/// The user's bits are dropped: what they stand for is looked at anyhow.
template <class A>
ReadyBits BasicDoorbell<A>::take_own() {
    const ReadyBits bits = take();
    ReadyBits own;
    for (const unsigned bit : {attention_bit, interrupt_bit})
        if (bits.test(bit)) own.set(bit);
    return own;
}

template <class A>
ReadyBits BasicDoorbell<A>::poll() {
    if (owner_ == Owner::listens) return rung() ? take() : ReadyBits{};
    become(Owner::listens);
    ReadyBits bits = take();
    for (unsigned bit = 0; bit < user_bits; ++bit) bits.set(bit);
    return bits;
}

template <class A>
ReadyBits BasicDoorbell<A>::wait(std::chrono::nanoseconds bound, const WaitOptions& how) {
    const ReadyBits bits = poll();
    if (bits.any()) return bits;
    return wait_until_done([&] { return rung(); }, bound, how, Owner::listens) ? take() : ReadyBits{};
}

// The owner's word and the data are two sides' words crossing (as in futex.hpp):
//
//     owner: word = sleeps or listens | fence | done()?        ringer: data | fence | word == looks?
//
// At least one of the two sees the other: either done() holds at once, or the ringer sets the bit and, if the
// owner sleeps, wakes it.
template <class A>
template <class Done>
bool BasicDoorbell<A>::wait_until_done(Done&& done, std::chrono::nanoseconds bound, const WaitOptions& how,
                                       Owner awake) {
    const auto longest = static_cast<std::uint64_t>(how.spin.count());
    if (how.mode != WaitMode::futex) {
        const std::uint64_t start = A::now();
        const std::uint64_t deadline = start + bounded_ns(bound);
        if (how.mode == WaitMode::spin) return spin_until<A>(deadline, done);
        const std::uint64_t enough = std::min(deadline, start + spin_.limit_ns(longest));
        if (how.mode == WaitMode::same_core ? yield_until<A>(enough, done) : spin_until<A>(enough, done)) {
            spin_.learn(longest, A::now() - start);
            return true;
        }
        bound = std::chrono::nanoseconds(deadline - std::min(deadline, A::now()));
        const bool found = wait_until_done(done, bound, {WaitMode::futex}, awake);
        spin_.learn(longest, A::now() - start);
        return found;
    }
    typename A::BoundedSleep sleep(bound);
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

/// News is looked for before bits: whoever was woken by a message reads that first, and takes the bit that
/// came with it in the next wait, when nobody is kept waiting by another transfer of the doorbell's line.
template <class A>
template <class Ready>
ReadyBits BasicDoorbell<A>::wait_for(Ready&& ready, std::chrono::nanoseconds bound, const WaitOptions& how) {
    if (rung()) {
        const ReadyBits own = take_own();
        if (own.any()) return own;
    }
    if (ready()) return {};
    if (owner_ != Owner::looks) become(Owner::looks);
    wait_until_done([&] { return ready() || rung(); }, bound, how, Owner::looks);
    return ready() || !rung() ? ReadyBits{} : take_own();
}

} // namespace tandem::shm
