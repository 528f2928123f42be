// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/tandem/bench_link.hpp"

namespace tandem::bench {

/// A link with one ring in each direction. Short messages are copied out of the ring; long messages are read
/// where they were written. The reader polls, like a component that calls isNew() or pop() in its own cycle,
/// or waits on its side's doorbell with wait_for(), which checks the ring. (The proxy's ArrivalNotifier,
/// which has many rings, waits with wait().)
template <std::size_t bytes, Wake wake>
class RingEndpoint {
  public:
    explicit RingEndpoint(Session& session, std::chrono::nanoseconds spin = shm::WaitOptions{}.spin)
        : RingEndpoint(session, wait_options(session.bench_case(), spin)) {}
    RingEndpoint(Session& session, const shm::WaitOptions& how)
        : wait_options_(how), link_(session, BenchLink::ring_bytes(bytes)),
          out_(link_.add_ring("out", bytes)), in_((link_.publish_and_wait(), link_.peer_ring("out"))) {}

    void send(std::uint64_t sequence) {
        write_message(out_, bytes, sequence);
        if (wake != Wake::spin) link_.segment().ring_peer(0); // a system call only if the reader sleeps
    }

    /// The doorbell's wait ends when a message has arrived. The limit of one second is only for a peer that
    /// has died.
    std::uint64_t receive() {
        for (;;) {
            if (const auto record = in_.read()) return checked_sequence(record->bytes.data(), bytes);
            if (wake != Wake::spin)
                link_.segment().doorbell().wait_for([this] { return !in_.empty(); }, std::chrono::seconds(1),
                                                    wait_options_);
        }
    }

  private:
    shm::WaitOptions wait_options_;
    BenchLink link_;
    shm::RingWriter out_;
    shm::RingReader in_;
};

} // namespace tandem::bench
