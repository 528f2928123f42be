// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/harness/tick_record.hpp"

#include <catch2/catch.hpp>

using tandem::bench::TickRecord;
using Times = std::vector<std::int64_t>;

namespace {
TickRecord recorded(const Times& ticks) {
    TickRecord record;
    record.prepare(100, 10, 0);
    for (const std::int64_t at : ticks) record.record_tick(at);
    return record;
}
} // namespace

TEST_CASE("A tick that is 3.2 periods late is one sample of 3.2 periods") {
    // Planned for 1100; the engine's next one, planned for 1400, comes at once.
    const TickRecord record = recorded({1005, 1420, 1421, 1507});
    CHECK(record.lateness_ns() == Times{5, 320, 7});
    CHECK(record.ticks() == 4);
    CHECK(record.counts().overruns == 1);
    CHECK(record.counts().skipped == 3);
}

TEST_CASE("A tick that is late by less than a period counts with its lateness") {
    const TickRecord record = recorded({1000, 1199, 1200, 1350});
    CHECK(record.lateness_ns() == Times{0, 99, 0, 50});
    CHECK(record.counts().overruns == 0);
    CHECK(record.counts().skipped == 0);
}

TEST_CASE("Skipped periods are part of the drift and no more samples are kept than there is room for") {
    TickRecord record = recorded({1000, 1500, 1600});
    CHECK(record.mean_drift_ns() == 0);
    record.record_tick(1706);
    CHECK(record.mean_drift_ns() == Approx(6.0 / 7));
    for (int i = 8; i < 40; ++i) record.record_tick(1000 + i * 100);
    CHECK(record.lateness_ns().size() <= 10);
    CHECK(record.ticks() == 36);
    CHECK(recorded({1000}).mean_drift_ns() == 0);
}
