// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/harness/payload.hpp"
#include "apps/bench/harness/summary.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>

using namespace tandem::bench;

namespace {

std::vector<double> one_to(int last) {
    std::vector<double> values(static_cast<std::size_t>(last));
    std::iota(values.begin(), values.end(), 1.0);
    return values;
}

} // namespace

TEST_CASE("Percentiles are nearest ranks of the samples in any order") {
    auto values = one_to(1000);
    std::reverse(values.begin(), values.end());
    const Summary s = summarize(values);
    CHECK(s.samples == 1000);
    CHECK(s.p50 == 500);
    CHECK(s.p90 == 900);
    CHECK(s.p99 == 990);
    CHECK(s.p999 == 999);
    CHECK(s.max == 1000);
}

TEST_CASE("The percentile curve ends at the last point that has a sample") {
    const Summary s = summarize(one_to(1000));
    REQUIRE(!s.curve.empty());
    CHECK(s.curve.front().share == 0);
    CHECK(s.curve.front().value == 1);
    CHECK(s.curve.back().share == Approx(0.999));
    CHECK(std::is_sorted(s.curve.begin(), s.curve.end(),
                         [](const CurvePoint& a, const CurvePoint& b) { return a.value < b.value; }));
}

TEST_CASE("A summary of no samples is zero") {
    const Summary s = summarize({});
    CHECK(s.samples == 0);
    CHECK(s.max == 0);
    CHECK(s.curve.empty());
}

TEST_CASE("The summary of several runs has the median of each percentile and the largest maximum") {
    const Summary s = median_of({summarize({1, 1, 1}), summarize({3, 3, 50}), summarize({9, 9, 9})});
    CHECK(s.samples == 9);
    CHECK(s.p50 == 3);
    CHECK(s.max == 50);
    CHECK(median({4, 1, 3, 2}) == 2.5);
}

TEST_CASE("The number of a message is read back, and a changed word is noticed") {
    for (std::size_t bytes : {8U, 64U, 4096U, 65536U}) {
        std::vector<std::uint64_t> words(bytes / 8);
        fill_message(words.data(), bytes, 77);
        CHECK(checked_sequence(words.data(), bytes) == 77);
        if (words.size() == 1) continue;
        words.back() += 1;
        CHECK_THROWS_WITH(checked_sequence(words.data(), bytes), Catch::Contains("is corrupt"));
    }
}
