// SPDX-License-Identifier: Apache-2.0
// Our shared memory as the cases use it: a link whose sides are A and B, and the wake modes in shm's terms.
#pragma once
#include "apps/bench/measure.hpp"
#include "shm/segment.hpp"

#include <memory>
#include <thread>

namespace tandem::bench {

inline shm::WaitOptions wait_options(Wake wake, std::chrono::nanoseconds spin = shm::WaitOptions{}.spin) {
    shm::WaitOptions how;
    how.spin = spin;
    how.mode = wake == Wake::spin              ? shm::WaitMode::spin
               : wake == Wake::spin_then_futex ? shm::WaitMode::spin_then_futex
                                               : shm::WaitMode::futex;
    return how;
}

class OurLink {
  public:
    OurLink(Session& session, std::size_t arena_bytes)
        : mine_(session.is_a() ? shm::Side::first : shm::Side::second) {
        shm::JoinOptions options;
        options.arena_bytes = arena_bytes;
        segment_ = shm::Segment::join(session.name(), mine_, options);
    }

    shm::Segment& segment() { return *segment_; }
    shm::Side mine() const { return mine_; }

    /// A ring of ours that we write.
    shm::RingHandle add_ring(const std::string& name, std::size_t bytes) {
        shm::RingOptions options;
        options.writer = mine_;
        options.policy = shm::RingPolicy::reject;
        options.max_record = bytes;
        options.capacity = std::max<std::size_t>(64 * 1024, 4 * (bytes + 64));
        return segment_->add_ring(name, options);
    }
    static std::size_t ring_bytes(std::size_t bytes) { // a generous bound of what add_ring() takes
        return std::size_t{256} * 1024 + 10 * bytes;
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
    shm::Side mine_;
    std::unique_ptr<shm::Segment> segment_;
};

} // namespace tandem::bench
