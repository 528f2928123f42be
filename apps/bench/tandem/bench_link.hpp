// SPDX-License-Identifier: Apache-2.0
// Our shared memory as the cases use it: a link whose sides are A and B, and the wake modes in shm's terms.
#pragma once
#include "apps/bench/harness/measurements.hpp"
#include "shm/segment.hpp"

#include <memory>
#include <thread>

namespace tandem::bench {

/// On one core, to spin means to yield.
inline shm::WaitOptions wait_options(Wake wake, Regime regime,
                                     std::chrono::nanoseconds spin = shm::WaitOptions{}.spin) {
    shm::WaitOptions how;
    how.spin = spin;
    how.mode = wake == Wake::spin              ? shm::WaitMode::spin
               : wake != Wake::spin_then_futex ? shm::WaitMode::futex
               : regime == Regime::same_core   ? shm::WaitMode::same_core
                                               : shm::WaitMode::spin_then_futex;
    return how;
}

class BenchLink {
  public:
    static constexpr std::size_t small_capacity = std::size_t{64} * 1024;

    BenchLink(Session& session, std::size_t arena_bytes)
        : mine_(session.is_a() ? shm::Side::first : shm::Side::second) {
        shm::JoinOptions options;
        options.arena_bytes = arena_bytes;
        segment_ = shm::Segment::join(session.name(), mine_, options);
    }

    shm::Segment& segment() { return *segment_; }
    shm::Side mine() const { return mine_; }

    /// A ring of ours that we write; long messages in chunks of their own.
    shm::RingHandle add_ring(const std::string& name, std::size_t bytes,
                             std::size_t capacity = small_capacity) {
        shm::RingOptions options;
        options.writer = mine_;
        options.policy = shm::RingPolicy::reject;
        options.capacity = capacity;
        if (bytes > longest_in_ring) {
            options.max_record = 64;
            options.chunk_bytes = bytes;
            options.chunks = chunks;
        } else {
            options.max_record = bytes;
        }
        return segment_->add_ring(name, options);
    }
    /// A generous bound of what such a ring takes.
    static std::size_t ring_bytes(std::size_t bytes, std::size_t capacity = small_capacity) {
        return std::size_t{256} * 1024 + 2 * capacity + (bytes > longest_in_ring ? chunks + 1 : 4) * bytes;
    }

    /// After all objects of this side are there: shows them, waits for the peer's.
    void open() {
        segment_->publish();
        while (!segment_->peer_published()) std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    shm::RingHandle peer_ring(const std::string& name) {
        const auto found = segment_->find_ring(shm::other(mine_), name);
        if (!found) throw std::runtime_error("the other side has no ring " + name);
        return *found;
    }

  private:
    static constexpr std::size_t longest_in_ring = 4096;
    static constexpr std::uint32_t chunks = 4;

    shm::Side mine_;
    std::unique_ptr<shm::Segment> segment_;
};

} // namespace tandem::bench
