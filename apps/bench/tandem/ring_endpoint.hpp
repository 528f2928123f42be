// SPDX-License-Identifier: Apache-2.0
// Two rings of ours, one for each direction: long messages are written and read in place.
#pragma once
#include "apps/bench/tandem/bench_link.hpp"

namespace tandem::bench {

template <std::size_t bytes, Wake wake>
class RingEndpoint {
  public:
    explicit RingEndpoint(Session& session, std::chrono::nanoseconds spin = shm::WaitOptions{}.spin)
        : how_(wait_options(wake, session.bench_case().regime, spin)),
          link_(session, BenchLink::ring_bytes(bytes)), out_(link_.add_ring("out", bytes)),
          in_((link_.open(), link_.peer_ring("out"))) {}

    void send(std::uint64_t sequence) {
        if constexpr (bytes <= 4096) { // copied: cheaper than in place
            alignas(8) std::byte message[bytes];
            fill_message(message, bytes, sequence);
            while (!out_.write(message, sequence, 0)) {
            } // full: the reader is behind
        } else {
            std::span<std::byte> room;
            while ((room = out_.reserve(bytes)).data() == nullptr) {
            }
            fill_message(room.data(), bytes, sequence);
            out_.commit(bytes, sequence, 0);
        }
        if (wake != Wake::spin) link_.segment().ring_peer(0);
    }

    std::uint64_t receive() {
        for (;;) {
            if (const auto record = in_.read()) return checked_sequence(record->bytes.data(), bytes);
            if (wake != Wake::spin)
                link_.segment().doorbell().wait_for([this] { return !in_.empty(); }, std::chrono::seconds(1),
                                                    how_);
        }
    }

  private:
    shm::WaitOptions how_;
    BenchLink link_;
    shm::RingWriter out_;
    shm::RingReader in_;
};

} // namespace tandem::bench
