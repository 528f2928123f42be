// SPDX-License-Identifier: Apache-2.0
#include <catch2/catch.hpp>

#include "apps/wheelchair/run/host_failure.hpp"

using namespace tandem::wheelchair;

namespace {

/// Ticks every 10 ms from 1.00 s; references until 2.00 s, voltages until `volts_until`.
struct Traces {
    std::vector<HWRecord> hw;
    std::vector<ControlRecord> control;

    explicit Traces(double volts_until) {
        for (int n = 100; n < 250; ++n) {
            ControlRecord c{};
            c.reference_read_at = n * 0.01 + 0.001;
            c.references_received = n <= 200;
            control.push_back(c);
            HWRecord h{};
            h.applied_at = n * 0.01 + 0.005;
            h.volts_left = h.volts_right = n * 0.01 <= volts_until ? 5.0 : 0.0;
            hw.push_back(h);
        }
    }
};

} // namespace

TEST_CASE("the stop is counted from the last reference, not from when the death was noticed") {
    const Traces t(2.035);
    const auto ms = motors_off_after_ms(2.012, t.hw, t.control);
    REQUIRE(ms);
    CHECK(*ms == Approx(44.0));
}

TEST_CASE("without a stop in the trace no stop time is reported") {
    const Traces t(9.0);
    CHECK_FALSE(motors_off_after_ms(2.012, t.hw, t.control));
    CHECK_FALSE(motors_off_after_ms(2.012, t.hw, {}));
}

TEST_CASE("the time until data flow again counts from the restarted host's ready line") {
    Traces t(2.035);
    HostFailure i;
    i.at = 2.012;
    CHECK(i.update(t.hw, t.control));
    CHECK(i.motors_off_after_ms);
    CHECK_FALSE(i.data_back_after_ms);
    i.restarted_at = 2.395;
    t.control[140].references_received = 1; // read at 2.401 s
    t.control[141].references_received = 1;
    CHECK(i.update(t.hw, t.control));
    CHECK(*i.data_back_after_ms == Approx(6.0));
    CHECK_FALSE(i.update(t.hw, t.control));
}
