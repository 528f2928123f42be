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

void Doorbell::ring_all(std::uint64_t bits) {
    constexpr auto sleeps = static_cast<std::uint32_t>(Owner::sleeps);
    constexpr auto listens = static_cast<std::uint32_t>(Owner::listens);
    constexpr auto looks = static_cast<std::uint32_t>(Owner::looks);
    // An owner that looked last time most likely still does, and then its line is only read. Otherwise the
    // line has to be written, and comes with the write.
    if (seen_.load(std::memory_order_relaxed) == looks && (bits & ~all_user_bits) == 0) {
        RealAtomics::fence(); // after the data, whose stores are only release
        if (words_.owner.load(std::memory_order_relaxed) == looks) return;
    }
    // Always a read-modify-write, even if the bits are set already: it stands between the data and the look
    // at the owner's word. Skipping it would let the owner take the old bit, miss the data, and sleep.
    words_.ready.fetch_or(bits, std::memory_order_seq_cst);
    std::uint32_t owner = words_.owner.load(std::memory_order_seq_cst);
    seen_.store(owner, std::memory_order_relaxed);
    // One of several ringers makes the call.
    if (owner != sleeps || !words_.owner.compare_exchange_strong(owner, listens, std::memory_order_seq_cst))
        return;
    futex_wake(words_.owner, 1);
    wakes_.fetch_add(1, std::memory_order_relaxed);
}

std::uint64_t Doorbell::poll() {
    if (owner_ != Owner::listens) {
        become(Owner::listens);
        return take() | all_user_bits;
    }
    return rung() ? take() : 0;
}

std::uint64_t Doorbell::wait(std::chrono::nanoseconds bound, const WaitOptions& how) {
    if (const std::uint64_t bits = poll()) return bits;
    return wait_until_done([&] { return rung(); }, bound, how, Owner::listens) ? take() : 0;
}

} // namespace tandem::shm
