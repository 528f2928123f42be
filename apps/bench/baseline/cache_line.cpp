// SPDX-License-Identifier: Apache-2.0
// The physical limit: what the clock costs, and how long one dirty cache line takes from core to core.
#include "apps/bench/harness/cases.hpp"
#include "apps/bench/harness/measurements.hpp"

namespace tandem::bench {

namespace {

/// One word to and fro, no ring around it. From message to message another line: how far a line is from a
/// core depends on its address, 130 to 180 ns on one machine, and a single one would be a matter of luck.
class LineEnd {
  public:
    explicit LineEnd(Session& session)
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
    session.begin();
    while (session.more()) {
        const std::uint64_t before = ticks();
        const std::uint64_t after = ticks();
        session.sample(after - before, after);
    }
    session.end();
}

} // namespace

void add_floor_line_cases(Registry& registry) {
    Case line;
    line.group = Group::floor;
    line.who = "cache-line";
    line.what = "one-way";
    line.bytes = 8;
    line.divisor = 2;
    line.run = echo<LineEnd>;
    registry.cases.push_back(line);
    line.placement = Placement::threads;
    registry.cases.push_back(line);

    Case clock;
    clock.group = Group::floor;
    clock.who = "clock";
    clock.what = "read";
    clock.bytes = 0;
    clock.wake = Wake::none;
    clock.placement = Placement::alone;
    clock.run = read_clock;
    registry.cases.push_back(clock);
}

} // namespace tandem::bench
