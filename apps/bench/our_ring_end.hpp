// SPDX-License-Identifier: Apache-2.0
// Two rings of ours, one for each direction: written in place, read in place where the ring can.
#pragma once
#include "apps/bench/our_link.hpp"

namespace tandem::bench {

template <std::size_t bytes, Wake wake>
class OurRingEnd {
  public:
    explicit OurRingEnd(Session& session, std::chrono::nanoseconds spin = shm::WaitOptions{}.spin)
        : how_(wait_options(wake, spin)), link_(session, OurLink::ring_bytes(bytes)),
          out_(link_.add_ring("out", bytes)), in_((link_.open(), link_.peer_ring("out"))) {}

    void send(std::uint64_t sequence) {
        std::span<std::byte> room;
        while ((room = out_.reserve(bytes)).data() == nullptr) {
        } // full: the reader is behind
        fill(room.data(), bytes, sequence);
        out_.commit(bytes, sequence, 0);
        if (wake != Wake::spin) link_.segment().ring_peer(0);
    }

    std::uint64_t receive() {
        for (;;) {
            if (const auto record = in_.peek()) {
                const std::uint64_t sequence = sequence_of(record->bytes.data(), bytes);
                in_.release();
                return sequence;
            }
            if (wake != Wake::spin) link_.segment().doorbell().wait(std::chrono::seconds(1), how_);
        }
    }

  private:
    shm::WaitOptions how_;
    OurLink link_;
    shm::RingWriter out_;
    shm::RingReader in_;
};

} // namespace tandem::bench
