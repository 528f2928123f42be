// SPDX-License-Identifier: Apache-2.0
#include <catch2/catch.hpp>

#include "apps/wheelchair/report/acceptance.hpp"

using namespace tandem::wheelchair;

namespace {

const std::vector<Row>& step20() {
    static const auto rows = simulate(find_scenario("step20"));
    return rows;
}

double value_of(const std::vector<AcceptanceCheck>& list, const std::string& name) {
    for (const auto& j : list)
        if (j.name == name) return j.value;
    FAIL("no figure " << name);
    return 0.0;
}

} // namespace

TEST_CASE("the simulated step has the figures of docs/wheelchair.md, section 8, and is accepted") {
    const auto list = check_step20(step20());
    CHECK(all_pass(list));
    CHECK(value_of(list, "time to 10 %") == Approx(0.0535).margin(1e-4));
    CHECK(value_of(list, "rise 10-90 %") == Approx(0.3242).margin(1e-4));
    CHECK(value_of(list, "overshoot") == Approx(0.2357).margin(1e-4));
    CHECK(value_of(list, "settling to 5 %") == Approx(0.45));
    CHECK(value_of(list, "settling to 2 %") == Approx(0.53));
    CHECK(value_of(list, "steady band, true") == Approx(0.0081).margin(1e-4));
    CHECK(value_of(list, "steady band, measured") == Approx(0.0599).margin(1e-4));
    CHECK(value_of(list, "largest voltage") == Approx(15.45).margin(0.01));
    CHECK(value_of(list, "largest current") == Approx(19.83).margin(0.01));
    CHECK(value_of(list, "lowest speed in the turn") == Approx(0.79).margin(0.001));
}

TEST_CASE("another drive is not accepted as the step, and a short one is not checked") {
    CHECK_FALSE(all_pass(check_step20(simulate(find_scenario("step20_slope")))));
    CHECK_FALSE(all_pass(check_step20(simulate(find_scenario("s_curve")))));
    CHECK(check_step20({step20().begin(), step20().begin() + 900}).empty());
}

TEST_CASE("one lost tick at the step makes two runs differ by more than is allowed") {
    auto late = step20();
    for (std::size_t n = 1000; n > 500; --n)
        late[n].steering_measured_deg = late[n - 1].steering_measured_deg;
    CHECK(all_pass(check_similar("same", step20(), step20())));
    CHECK_FALSE(all_pass(check_similar("late", step20(), late)));
}

TEST_CASE("a difference in one logged digit makes lock-step runs different") {
    auto other = step20();
    other[700].steering_true_deg += 1e-5;
    CHECK(all_pass(check_identical("same", step20(), step20())));
    const auto checked = check_identical("other", step20(), other);
    CHECK_FALSE(all_pass(checked));
    CHECK(checked[0].value == 1);
    other.pop_back();
    CHECK(check_identical("shorter", step20(), other)[0].value == 2);
}

TEST_CASE("runs too short to compare fail") {
    CHECK_FALSE(all_pass(check_similar("short", step20(), {})));
    CHECK_THAT(acceptance_table("Title", check_similar("short", step20(), {})), Catch::Contains("FAIL"));
}
