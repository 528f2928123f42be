// SPDX-License-Identifier: Apache-2.0
#include "shm/ring/reader_backoff.hpp"

#include <catch2/catch.hpp>

using tandem::shm::ReaderBackoff;

namespace {

/// Counts what a reader would have waited.
struct CountedPauses {
    static inline int count = 0;
    static void pause() { ++count; }
};

/// Simulates a reader and a writer. The writer has `ahead` records ready after the reader has found none `looks` times.
int pauses_in(ReaderBackoff<CountedPauses>& backoff, int rounds, int ahead, int looks) {
    CountedPauses::count = 0;
    for (int round = 0; round < rounds; ++round) {
        for (int i = 0; i < ahead; ++i) backoff.on_record();
        for (int i = 0; i < looks; ++i) backoff.on_nothing();
    }
    return CountedPauses::count;
}

} // namespace

TEST_CASE("a reader pauses for a writer that gets ahead meanwhile") {
    ReaderBackoff<CountedPauses> backoff;
    const int pause = pauses_in(backoff, 1, 100, 1);
    REQUIRE(pause > 0);
    CHECK(pauses_in(backoff, 1000, 10, 2) == 1000 * pause);
}

TEST_CASE("a reader pauses in each burst that follows a long silence") {
    ReaderBackoff<CountedPauses> backoff;
    const int pause = pauses_in(backoff, 1, 100, 100);
    REQUIRE(pause > 0);
    CHECK(pauses_in(backoff, 1000, 100, 100) == 1000 * pause);
}

TEST_CASE("a reader does not pause for a writer that waits for its answer") {
    ReaderBackoff<CountedPauses> backoff;
    const int pause = pauses_in(backoff, 1, 100, 1);
    // It tries again, since the writer may have changed, but seldom.
    CHECK(pauses_in(backoff, 100'000, 1, 3) / pause < 20);
    CHECK(pauses_in(backoff, 100'000, 1, 3) / pause < 20);
    // It pauses again when the writer gets ahead.
    CHECK(pauses_in(backoff, 20'000, 4, 2) / pause > 10'000);
}

TEST_CASE("a reader that finds nothing for a long time does not pause") {
    ReaderBackoff<CountedPauses> backoff;
    CHECK(pauses_in(backoff, 1000, 1, 100) == 0);
}
