// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/measurements/measurements.hpp"

namespace tandem::bench {

/// One word in each direction, without a ring. Each message uses the next of 64 lines: the time of a line to a
/// core depends on its address (130 to 180 ns on one machine), so the result of a single line would depend on
/// chance.
class LineEndpoint {
  public:
    /// `place`: the place of the lines of both directions in the session's memory.
    explicit LineEndpoint(Session& session, std::size_t place = 0)
        : out_(words(session, 2 * place + (session.is_side_a() ? 0 : 1))),
          in_(words(session, 2 * place + (session.is_side_a() ? 1 : 0))) {}
    void send(std::uint64_t sequence) { word(out_, sent_++).store(sequence, std::memory_order_release); }
    std::uint64_t receive() {
        auto& incoming = word(in_, received_);
        // The line still contains the message of 64 messages ago. A new one has arrived when the word changes.
        const std::uint64_t before = last_[received_ % lines];
        std::uint64_t now = before;
        while (now == before) now = incoming.load(std::memory_order_acquire);
        return last_[received_++ % lines] = now;
    }

  private:
    using Word = std::atomic<std::uint64_t>;
    // 128 bytes, because the prefetcher fetches lines in pairs and would also move the neighbour.
    static constexpr std::size_t lines = 64, distance = 128;
    static std::byte* words(Session& session, std::size_t direction) {
        return session.memory().data() + direction * lines * distance;
    }
    static Word& word(std::byte* words, std::size_t index) {
        return *reinterpret_cast<Word*>(words + index % lines * distance);
    }
    std::byte *out_, *in_;
    std::size_t sent_ = 0, received_ = 0;
    std::uint64_t last_[lines] = {};
};

} // namespace tandem::bench
