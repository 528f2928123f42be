// SPDX-License-Identifier: Apache-2.0
#include <catch2/catch.hpp>

#include <numeric>

#include "apps/wheelchair/report/latency.hpp"

using namespace tandem::wheelchair;

namespace {

JoystickRecord sent(double stamp) {
    JoystickRecord r{};
    r.sent = 1;
    r.stamp = stamp;
    return r;
}

ControlRecord received(double stamp, double read_at, double count = 1) {
    ControlRecord r{};
    r.reference_stamp = stamp;
    r.reference_read_at = read_at;
    r.references_received = count;
    return r;
}

} // namespace

TEST_CASE("statistics give the deviation of the sample") {
    const auto s = statistics({2, 4, 4, 4, 5, 5, 7, 9});
    CHECK(s.average == 5);
    CHECK(s.deviation == Approx(2.13809));
    CHECK(s.min == 2);
    CHECK(s.max == 9);
    CHECK(statistics({}).samples == 0);
}

TEST_CASE("percentiles are values that occurred") {
    std::vector<double> v(1000);
    std::iota(v.begin(), v.end(), 1.0);
    CHECK(percentile(v, 0.5) == 500);
    CHECK(percentile(v, 0.99) == 990);
    CHECK(percentile(v, 0.999) == 999);
    CHECK(percentile(v, 1.0) == 1000);
    CHECK(percentile({}, 0.5) == 0);
    CHECK(percentile({7}, 0.999) == 7);
}

TEST_CASE("Table 1 takes 100 samples after the first second, or fewer if there are fewer") {
    std::vector<double> v(250);
    std::iota(v.begin(), v.end(), 0.0);
    CHECK(table_samples(v).size() == 100);
    CHECK(table_samples(v).front() == 100);
    v.resize(30);
    CHECK(table_samples(v).size() == 30);
}

TEST_CASE("a tick without a new reference is not a latency sample") {
    const auto us = latencies_us({received(1.0, 1.000005), received(1.0, 1.01, 0), received(1.02, 1.020010)});
    REQUIRE(us.size() == 2);
    CHECK(us[0] == Approx(5.0).margin(1e-3));
    CHECK(us[1] == Approx(10.0).margin(1e-3));
}

TEST_CASE("a reference overtaken within a tick is received, one that never arrived is lost") {
    const std::vector<JoystickRecord> joystick{sent(1), sent(2), sent(3), sent(4), sent(5), sent(6)};
    const auto all = count_samples(joystick, {received(2, 2.1), received(4, 4.1, 2), received(5, 5.1)});
    CHECK(all.sent == 4);
    CHECK(all.received == 4);
    CHECK(all.lost == 0);
    const auto gap = count_samples(joystick, {received(2, 2.1), received(4, 4.1, 1), received(5, 5.1)});
    CHECK(gap.lost == 1);
    CHECK(count_samples(joystick, {}).received == 0);
}

TEST_CASE("the tables have a line for each configuration") {
    const auto text = latency_tables({{"opros", std::vector<double>(300, 1.0), {300, 300, 0}},
                                      {"mixed", std::vector<double>(300, 4.5), {300, 299, 1}}});
    CHECK_THAT(text, Catch::Contains("100 samples"));
    CHECK_THAT(text, Catch::Contains("  mixed         4.50      0.00      4.50      4.50"));
    CHECK_THAT(text, Catch::Contains("     300       299      1\n"));
    CHECK_THAT(text, Catch::Contains("p50 of mixed minus p50 of opros: +3.50 us"));
}
