// SPDX-License-Identifier: Apache-2.0
// The physical limit: what the clock costs, and how long one dirty cache line takes from core to core.
#include "apps/bench/cases.hpp"
#include "apps/bench/measure.hpp"

namespace tandem::bench {

namespace {

/// One word to and fro, no ring around it.
class LineEnd {
  public:
    explicit LineEnd(Session& session)
        : out_(word(session, session.is_a() ? 0 : 1)), in_(word(session, session.is_a() ? 1 : 0)) {}
    void send(std::uint64_t sequence) { out_.store(sequence, std::memory_order_release); }
    std::uint64_t receive() {
        std::uint64_t now = last_;
        while (now == last_) now = in_.load(std::memory_order_acquire);
        return last_ = now;
    }

  private:
    static std::atomic<std::uint64_t>& word(Session& session, int index) {
        return *reinterpret_cast<std::atomic<std::uint64_t>*>(session.memory().data() + index * 256);
    }
    std::atomic<std::uint64_t>&out_, &in_;
    std::uint64_t last_ = 0;
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
