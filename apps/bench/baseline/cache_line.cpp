// SPDX-License-Identifier: Apache-2.0
// The physical limit: what the clock costs, and how long one dirty cache line takes from core to core.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/measurements.hpp"

namespace tandem::bench {

namespace {

/// One word to and fro, no ring around it. From message to message another line: how far a line is from a
/// core depends on its address, 130 to 180 ns on one machine, and a single one would be a matter of luck.
class LineEndpoint {
  public:
    explicit LineEndpoint(Session& session)
        : out_(words(session, session.is_a() ? 0 : 1)), in_(words(session, session.is_a() ? 1 : 0)) {}
    void send(std::uint64_t sequence) { word(out_, sent_++).store(sequence, std::memory_order_release); }
    std::uint64_t receive() {
        auto& word_now = word(in_, received_);
        const std::uint64_t before = last_[received_ % lines];
        std::uint64_t now = before;
        while (now == before) now = word_now.load(std::memory_order_acquire);
        return last_[received_++ % lines] = now;
    }

  private:
    using Word = std::atomic<std::uint64_t>;
    static constexpr std::size_t lines = 64, apart = 128;
    static std::byte* words(Session& session, std::size_t index) {
        return session.memory().data() + index * lines * apart;
    }
    static Word& word(std::byte* words, std::size_t index) {
        return *reinterpret_cast<Word*>(words + index % lines * apart);
    }
    std::byte *out_, *in_;
    std::size_t sent_ = 0, received_ = 0;
    std::uint64_t last_[lines] = {};
};

void read_clock(Session& session) {
    session.begin_measuring();
    while (session.needs_more()) {
        const std::uint64_t before = ticks();
        const std::uint64_t after = ticks();
        session.add_sample(after - before, after);
    }
    session.end_measuring();
}

} // namespace

void add_cache_line_cases(Registry& registry) {
    Case line;
    line.group = Group::baseline;
    line.subject = "cache-line";
    line.operation = "one-way";
    line.bytes = 8;
    line.divisor = 2;
    line.run = measure_round_trips<LineEndpoint>;
    registry.cases.push_back(line);
    line.placement = Placement::threads;
    registry.cases.push_back(line);

    Case clock;
    clock.group = Group::baseline;
    clock.subject = "clock";
    clock.operation = "read";
    clock.bytes = 0;
    clock.wake = Wake::none;
    clock.placement = Placement::alone;
    clock.run = read_clock;
    registry.cases.push_back(clock);
}

} // namespace tandem::bench
