// SPDX-License-Identifier: Apache-2.0
#include "shm/doorbell.hpp"

namespace tandem::shm {

Doorbell::Doorbell(std::shared_ptr<const Mapping> mapping, Side owner)
    : mapping_(std::move(mapping)), words_(mapping_->half(owner).doorbell) {}

void Doorbell::ring_all(std::uint64_t bits) {
    // Always a read-modify-write, even if the bits are set already: it is also the barrier between the data
    // published before and the look at `sleeping`. Skipping it would let the owner take the old bit, miss the
    // data, and sleep.
    words_.ready.fetch_or(bits, std::memory_order_seq_cst);
    if (wake(words_.sleeping)) wakes_.fetch_add(1, std::memory_order_relaxed);
}

std::uint64_t Doorbell::poll() {
    if (words_.ready.load(std::memory_order_relaxed) == 0) return 0;
    return words_.ready.exchange(0, std::memory_order_seq_cst);
}

std::uint64_t Doorbell::wait(std::chrono::nanoseconds bound, const WaitOptions& how) {
    if (const std::uint64_t bits = poll()) return bits;
    wait_until(words_.sleeping, how, deadline_after(bound),
               [&] { return words_.ready.load(std::memory_order_seq_cst) != 0; });
    return poll();
}

} // namespace tandem::shm
