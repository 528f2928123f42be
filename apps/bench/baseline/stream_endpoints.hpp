// SPDX-License-Identifier: Apache-2.0
// The minimal ring as the floor of streams. If the slots themselves are filled and read, the floor is
// IndexRingEndpoint.
#pragma once
#include "apps/bench/baseline/index_ring_endpoint.hpp"

#include <cstring>
#include <vector>

namespace tandem::bench {

/// One ring, tuned for throughput, in one of several places of the session's memory.
class SmallStreamEndpoint {
  public:
    explicit SmallStreamEndpoint(Session& session, std::size_t place = 0)
        : ring_(session.memory().data() + place * mebibyte) {}
    void send(std::uint64_t sequence) { write_slot<bytes>(ring_, sequence); }
    std::uint64_t receive() { return read_slot<bytes>(ring_); }

  private:
    static constexpr std::size_t bytes = 64;
    using Ring = IndexRing<bytes, 8192, Wake::spin, RingTuning::throughput>;
    static_assert(Ring::memory_bytes <= mebibyte);
    Ring ring_;
};

/// One copy in and one copy out, as in a transport that does not lend its slots to the user.
template <std::size_t bytes>
class CopyingEndpoint {
  public:
    explicit CopyingEndpoint(Session& session, std::size_t /*place*/ = 0)
        : buffer_(bytes / sizeof(std::uint64_t)), ring_(session.memory().data()) {}
    void send(std::uint64_t sequence) {
        fill_message(buffer_.data(), bytes, sequence);
        std::memcpy(ring_.claim(), buffer_.data(), bytes);
        ring_.publish();
    }
    std::uint64_t receive() {
        std::memcpy(buffer_.data(), ring_.wait_for_slot(), bytes);
        ring_.release();
        return checked_sequence(buffer_.data(), bytes);
    }

  private:
    std::vector<std::uint64_t> buffer_;
    IndexRing<bytes, 4, Wake::spin> ring_;
};

} // namespace tandem::bench
