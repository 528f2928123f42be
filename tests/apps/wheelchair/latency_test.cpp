// SPDX-License-Identifier: Apache-2.0
#include <catch2/catch.hpp>

#include <limits>
#include <numeric>
#include <thread>

#include "apps/wheelchair/report/latency.hpp"
#include "plugins/wheelchair/core/body/core_wait.hpp"

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
    std::vector<LatencySample> v(250);
    for (std::size_t i = 0; i < v.size(); ++i) v[i].us = static_cast<double>(i);
    CHECK(table_samples(v).size() == 100);
    CHECK(table_samples(v).front().us == 100);
    CHECK(without_start(v).size() == 150);
    v.resize(30);
    CHECK(table_samples(v).size() == 30);
}

TEST_CASE("a tick without a new reference is not a latency sample") {
    const auto us =
        values_us(latencies({}, {received(1.0, 1.000005), received(1.0, 1.01, 0), received(1.02, 1.020010)}));
    REQUIRE(us.size() == 2);
    CHECK(us[0] == Approx(5.0).margin(1e-3));
    CHECK(us[1] == Approx(10.0).margin(1e-3));
}

TEST_CASE("a sample is disturbed if the sender or the receiver waited for a core in its tick") {
    std::vector<JoystickRecord> joystick{sent(1), sent(2), sent(3), sent(4)};
    std::vector<ControlRecord> control{received(1, 1.1), received(2, 2.1), received(3, 3.1),
                                       received(4, 4.1)};
    joystick[1].core_taken = 1e-3;
    control[2].core_taken = 1e-3;
    control[3].core_taken = std::numeric_limits<double>::quiet_NaN(); // the kernel does not count it
    const auto samples = latencies(joystick, control);
    REQUIRE(samples.size() == 4);
    CHECK_FALSE(samples[0].disturbed);
    CHECK(samples[1].disturbed);
    CHECK(samples[2].disturbed);
    CHECK_FALSE(samples[3].disturbed);
    CHECK(values_us(samples, Samples::undisturbed).size() == 2);
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

TEST_CASE("references are lost if no more arrive, except in the last second, in which the hosts stop") {
    std::vector<JoystickRecord> joystick;
    std::vector<ControlRecord> control;
    for (int n = 1; n <= 500; ++n) {
        joystick.push_back(sent(n));
        control.push_back(received(n, n + 0.1, n <= 200 ? 1 : 0));
        joystick.back().at = control.back().at = 0.01 * n;
    }
    CHECK(count_samples(joystick, control).lost == 199); // 201 to 399
    control.resize(300);
    CHECK(count_samples(joystick, control).lost == 0);
}

TEST_CASE("a configuration without a sample has no figures") {
    const std::vector<LatencySample> disturbed(300, {900.0, true});
    const auto text = latency_tables({{"opros", {}, {0, 0, 0}}, {"mixed", disturbed, {300, 300, 0}}});
    CHECK_THAT(text, Catch::Contains("100 samples"));
    CHECK_THAT(text, Catch::Contains("  opros    no sample\n"));
    CHECK_THAT(text, Catch::Contains("  mixed    no sample\n")); // of the undisturbed ones
    CHECK_THAT(text, !Catch::Contains(" 0.00      0.00      0.00") && !Catch::Contains("p50 of mixed minus"));
}

TEST_CASE("the tables have a line for each configuration") {
    const auto text = latency_tables({{"opros", std::vector<LatencySample>(300, {1.0}), {300, 300, 0}},
                                      {"mixed", std::vector<LatencySample>(300, {4.5}), {300, 299, 1}}});
    CHECK_THAT(text, Catch::Contains("100 samples"));
    CHECK_THAT(text, Catch::Contains("  mixed         4.50      0.00      4.50      4.50"));
    CHECK_THAT(text, Catch::Contains("     300       299      1\n"));
    CHECK_THAT(text, Catch::Contains("p50 of mixed minus p50 of opros: +3.50 us"));
    CHECK_THAT(text, !Catch::Contains("Without"));
}

TEST_CASE("the tables are repeated without disturbed samples") {
    std::vector<LatencySample> samples(300, {1.0});
    samples[120] = {900.0, true};
    const auto text = latency_tables({{"mixed", samples, {300, 300, 0}}});
    const auto second = text.substr(std::min(text.find("Without the samples"), text.size()));
    CHECK_THAT(text, Catch::Contains("  mixed         9.99     89.90      1.00    900.00"));
    CHECK_THAT(second, Catch::Contains("99 samples"));
    CHECK_THAT(second, Catch::Contains("  mixed         1.00      0.00      1.00      1.00"));
    CHECK_THAT(second, Catch::Contains("     199         1\n"));
}

TEST_CASE("a thread whose core is free has not waited for it") {
    CoreWait wait;
    CHECK(wait.seconds_since_last_call() == 0);
    CHECK_FALSE(wait.seconds_since_last_call() < 0);
    std::thread([&] {
        CHECK(wait.seconds_since_last_call() == 0);
    }).join(); // another thread's count starts at 0
}
