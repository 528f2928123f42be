// SPDX-License-Identifier: Apache-2.0
// A drive by hand may last for hours: what is kept of it in memory and in files is bounded.
#include "apps/wheelchair/run/trace_follower.hpp"

#include "scratch_dir.hpp"

#include <catch2/catch.hpp>
#include <sys/stat.h>

using namespace tandem::wheelchair;

namespace {

constexpr int ticks = 200'000;

JoystickRecord numbered(double n) {
    JoystickRecord r{};
    r.tick = n;
    return r;
}

long bytes_on_disk(const std::filesystem::path& file) {
    struct stat found {};
    REQUIRE(stat(file.c_str(), &found) == 0);
    return 512 * found.st_blocks;
}

} // namespace

TEST_CASE("a follower with a limit keeps the newest records, and their file stays small") {
    const ScratchDir dir;
    Trace<JoystickRecord> trace(dir / "a.trace");
    TraceFollower<JoystickRecord> all(dir / "a.trace"), newest(dir / "a.trace", {1000, true});
    for (int n = 0; n < ticks; ++n) {
        trace.append(numbered(n));
        if (n % 100 != 0) continue;
        newest.update();
        REQUIRE(newest.records().size() <= 2000);
        REQUIRE(newest.records().back().tick == n);
        REQUIRE(newest.records().front().tick == static_cast<double>(newest.dropped()));
    }
    newest.update();
    CHECK(newest.records().size() >= 1000);
    all.update();
    CHECK(all.records().size() == ticks);
    CHECK(all.dropped() == 0);
    // The writer allocates the file in chunks of 8192 records.
    CHECK(bytes_on_disk(dir / "a.trace") < 4 * 8192 * static_cast<long>(sizeof(JoystickRecord)));
}

TEST_CASE("a run of hours keeps a bounded number of records, and one of minutes all") {
    CHECK(limit_of_run(10.0, false).records == 0);
    CHECK(limit_of_run(720.0, false).records == 0);
    CHECK(limit_of_run(7200.0, false).records == 36'000);
    CHECK(limit_of_run(7200.0, false).discard_files);
    CHECK_FALSE(limit_of_run(7200.0, true).discard_files); // --keep
}
