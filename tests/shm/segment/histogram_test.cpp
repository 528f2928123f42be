// SPDX-License-Identifier: Apache-2.0
#include "shm/segment/histogram.hpp"

#include <catch2/catch.hpp>

using tandem::shm::layout::Histogram;

TEST_CASE("every duration falls into the bucket whose bounds enclose it") {
    for (std::size_t bucket = 0; bucket + 1 < Histogram::buckets; ++bucket) {
        CHECK(Histogram::bucket_of(Histogram::lower_bound_of(bucket)) == bucket);
        CHECK(Histogram::bucket_of(Histogram::lower_bound_of(bucket + 1) - 1) == bucket);
    }
    CHECK(Histogram::lower_bound_of(Histogram::buckets - 1) > 70'000'000'000);
    CHECK(Histogram::bucket_of(~std::uint64_t{0}) == Histogram::buckets - 1);
}

TEST_CASE("a histogram counts") {
    Histogram histogram{};
    for (int i = 0; i < 5; ++i) histogram.add(100);
    histogram.add(0);
    CHECK(histogram.counts[Histogram::bucket_of(100)] == 5);
    CHECK(histogram.counts[0] == 1);
}
