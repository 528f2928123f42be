// SPDX-License-Identifier: Apache-2.0
#include "shm/doorbell.hpp"

namespace tandem::shm {

Doorbell::Doorbell(std::shared_ptr<const Mapping> mapping, Side owner)
    : mapping_(std::move(mapping)), words_(mapping_->half(owner).doorbell) {}

void Doorbell::become(Owner state) {
    owner_ = state;
    words_.owner.store(static_cast<std::uint32_t>(state), std::memory_order_seq_cst);
    RealAtomics::fence(); // before the look at the rings, whose loads are only acquire
}

void Doorbell::ring(unsigned bit) {
    // An owner that looked last time most likely still does, and then its line is only read. Otherwise the
    // line has to be written, and comes with the write.
    constexpr auto looks = static_cast<std::uint32_t>(Owner::looks);
    if (bit < user_bits && seen_.load(std::memory_order_relaxed) == looks) {
        RealAtomics::fence(); // after the data, whose stores are only release
        if (words_.owner.load(std::memory_order_relaxed) == looks) return;
    }
    // Always a read-modify-write, even if the bit is set already: it stands between the data and the look at
    // the owner's word. Skipping it would let the owner take the old bit, miss the data, and sleep.
    words_.ready[bit / 64 % layout::doorbell_words].fetch_or(std::uint64_t{1} << (bit % 64),
                                                             std::memory_order_seq_cst);
    wake_owner();
}

void Doorbell::ring_all(const ReadyBits& bits) {
    for (std::size_t i = 0; i < bits.words.size(); ++i)
        if (bits.words[i] != 0) words_.ready[i].fetch_or(bits.words[i], std::memory_order_seq_cst);
    wake_owner();
}

void Doorbell::wake_owner() {
    constexpr auto sleeps = static_cast<std::uint32_t>(Owner::sleeps);
    constexpr auto listens = static_cast<std::uint32_t>(Owner::listens);
    std::uint32_t owner = words_.owner.load(std::memory_order_seq_cst);
    if (seen_.load(std::memory_order_relaxed) != owner) seen_.store(owner, std::memory_order_relaxed);
    // One of several ringers makes the call.
    if (owner != sleeps || !words_.owner.compare_exchange_strong(owner, listens, std::memory_order_seq_cst))
        return;
    futex_wake(words_.owner, 1);
    wakes_.fetch_add(1, std::memory_order_relaxed);
}

ReadyBits Doorbell::take() {
    ReadyBits bits;
    for (std::size_t i = 0; i < bits.words.size(); ++i)
        if (words_.ready[i].load(std::memory_order_relaxed) != 0)
            bits.words[i] = words_.ready[i].exchange(0, std::memory_order_seq_cst);
    return bits;
}

ReadyBits Doorbell::poll() {
    if (owner_ == Owner::listens) return rung() ? take() : ReadyBits{};
    become(Owner::listens);
    ReadyBits bits = take();
    for (unsigned bit = 0; bit < user_bits; ++bit) bits.set(bit);
    return bits;
}

ReadyBits Doorbell::wait(std::chrono::nanoseconds bound, const WaitOptions& how) {
    const ReadyBits bits = poll();
    if (bits.any()) return bits;
    return wait_until_done([&] { return rung(); }, bound, how, Owner::listens) ? take() : ReadyBits{};
}

} // namespace tandem::shm
