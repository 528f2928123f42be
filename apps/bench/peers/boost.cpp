// SPDX-License-Identifier: Apache-2.0
// Boost.Interprocess message_queue: a mutex, two condition variables and a copy each way, in shared memory.
#include "apps/bench/peers/peer_cases.hpp"

#include <boost/interprocess/ipc/message_queue.hpp>

namespace tandem::bench {

namespace {

// A writes queue 0, B writes queue 1. The first side to arrive creates a queue; the runner removes both.
namespace bip = boost::interprocess;

/// A queue in each direction.
template <std::size_t bytes, Wake wake>
class BoostEndpoint {
  public:
    explicit BoostEndpoint(Session& session)
        : out_(bip::open_or_create, (session.name() + (session.is_side_a() ? "-0" : "-1")).c_str(), depth,
               bytes),
          in_(bip::open_or_create, (session.name() + (session.is_side_a() ? "-1" : "-0")).c_str(), depth,
              bytes) {}
    void send(std::uint64_t sequence) {
        message_.fill(sequence);
        out_.send(message_.data(), bytes, 0);
    }
    std::uint64_t receive() {
        bip::message_queue::size_type size = 0;
        unsigned priority = 0;
        // receive() locks the mutex and sleeps on a condition variable in shared memory; try_receive() only locks.
        if constexpr (wake == Wake::spin)
            while (!in_.try_receive(message_.data(), bytes, size, priority)) {
            }
        else
            in_.receive(message_.data(), bytes, size, priority);
        return message_.checked_sequence();
    }

  private:
    // The messages that fit. Only a few messages if they are large, because otherwise the queue would exceed the memory.
    static constexpr std::size_t depth = bytes <= 4096 ? 1024 : 4;
    Message<bytes> message_;
    bip::message_queue out_, in_;
};

} // namespace

void add_boost_cases(Registry& registry) {
    PeerCases cases(registry, "boost-message-queue");
    cases.add_one_way<BoostEndpoint<64, Wake::spin>>(Wake::spin);
    cases.add_one_way<BoostEndpoint<64, Wake::blocking>>(Wake::blocking);
    cases.add_call<PairClientOf<BoostEndpoint<64, Wake::spin>>, PairServerOf<BoostEndpoint<64, Wake::spin>>>(
        Wake::spin, "pair");
    cases.add_small_stream<BoostEndpoint<64, Wake::blocking>>(Wake::blocking);
    cases.add_large_stream<BoostEndpoint<mebibyte, Wake::blocking>>(mebibyte, Wake::blocking, "copy");
    cases.add_large_stream<BoostEndpoint<6 * mebibyte, Wake::blocking>>(6 * mebibyte, Wake::blocking, "copy");
}

} // namespace tandem::bench
