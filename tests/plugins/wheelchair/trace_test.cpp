// SPDX-License-Identifier: Apache-2.0
#include <catch2/catch.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "tests/apps/wheelchair/scratch_dir.hpp"
#include "tests/plugins/wheelchair/read_trace.hpp"

using namespace tandem::wheelchair;

namespace {

JoystickRecord numbered(double n) {
    JoystickRecord r{};
    r.tick = n;
    r.stamp = -n;
    return r;
}

/// Overwrites bytes of a file as a damaged disk would.
template <class T>
void poke(const std::filesystem::path& path, std::streamoff at, T value) {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(at);
    file.write(reinterpret_cast<const char*>(&value), sizeof value);
}

} // namespace

TEST_CASE("records are read back in order, even when the file grows") {
    const ScratchDir dir;
    const auto path = dir / "a.trace";
    Trace<JoystickRecord> trace(path);
    for (int n = 0; n < 20000; ++n) trace.append(numbered(n));
    const auto back = read_trace<JoystickRecord>(path);
    REQUIRE(back.size() == 20000);
    for (int n : {0, 8191, 8192, 16384, 19999}) CHECK(back[n].stamp == -n);
    CHECK(read_trace<JoystickRecord>(path, 19990).size() == 10);
}

TEST_CASE("records survive a SIGKILL of their writer, and the next process appends to them") {
    const ScratchDir dir;
    const auto path = dir / "a.trace";
    const pid_t child = fork();
    if (child == 0) {
        Trace<JoystickRecord> trace(path);
        for (int n = 0; n < 100; ++n) trace.append(numbered(n));
        raise(SIGKILL);
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK(read_trace<JoystickRecord>(path).size() == 100);
    Trace<JoystickRecord>(path).append(numbered(100));
    CHECK(read_trace<JoystickRecord>(path).back().tick == 100);
}

TEST_CASE("a component without a trace file records nothing and works") {
    Trace<JoystickRecord> trace("");
    trace.append(numbered(1));
    CHECK(read_trace<JoystickRecord>("/nonexistent.trace").empty());
}

TEST_CASE("a second writer, other columns and foreign files are refused in one line") {
    const ScratchDir dir;
    const auto path = dir / "a.trace";
    {
        Trace<JoystickRecord> first(path);
        CHECK_THROWS_WITH(Trace<JoystickRecord>(path), Catch::Contains("another component writes it"));
        CHECK_THROWS_WITH(read_trace<ControlRecord>(path), Catch::Contains("other columns"));
    }
    CHECK_THROWS_WITH(Trace<HWRecord>(path), Catch::Contains("other columns"));
    std::ofstream(dir / "b") << "hello";
    CHECK_THROWS_WITH(Trace<HWRecord>((dir / "b").string()), Catch::Contains("too short"));
    std::ofstream(dir / "c") << std::string(5000, 'x');
    CHECK_THROWS_WITH(read_trace<HWRecord>((dir / "c").string()), Catch::Contains("not a trace file"));
    CHECK_THROWS_WITH(Trace<HWRecord>("/nonexistent/x.trace"), Catch::Contains("cannot be opened"));
}

TEST_CASE("a damaged count of records is an error and not a read past the end") {
    const ScratchDir dir;
    const auto path = dir / "a.trace";
    Trace<JoystickRecord>(path).append(numbered(1));
    poke(path, offsetof(TraceHeader, committed), std::uint64_t{1} << 60);
    CHECK_THROWS_WITH(read_trace<JoystickRecord>(path), Catch::Contains("damaged"));
    CHECK_THROWS_WITH(Trace<JoystickRecord>(path), Catch::Contains("damaged"));
}
