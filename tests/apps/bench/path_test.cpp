// SPDX-License-Identifier: Apache-2.0
// The length of each path in instructions: counted correctly, equal in each run, and below an upper bound.
#include "apps/bench/harness/forked_children.hpp"
#include "apps/bench/path/path_recorder.hpp"
#include "apps/bench/report/report.hpp"
#include "host/process/run_command.hpp"
#include "tests/apps/bench/read_report.hpp"
#include "tests/support/membarrier.hpp"
#include "tests/support/skip.hpp"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <thread>
#include <unistd.h>

using namespace tandem::bench;

namespace {

/// Shared with a forked child.
struct SharedFlag {
    SharedFlag()
        : memory(mmap(nullptr, sizeof(std::atomic<int>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS,
                      -1, 0)) {}
    ~SharedFlag() { munmap(memory, sizeof(std::atomic<int>)); }
    std::atomic<int>& value() const { return *static_cast<std::atomic<int>*>(memory); }
    void* memory;
};

std::atomic<int> counter;
void* volatile allocated;

/// One allocation, two locked additions, one system call, as the message that a thread sends to itself.
[[noreturn]] void run_known_operations(std::atomic<int>& traced) {
    while (traced.load() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    for (;;) {
        mark(PathMark::send_begin);
        allocated = std::malloc(100);
        counter.fetch_add(1);
        counter.fetch_add(1);
        syscall(SYS_getppid);
        mark(PathMark::send_end);
        std::free(allocated);
        mark(PathMark::receive_begin);
        mark(PathMark::receive_end);
    }
}

/// Returns the report of tandem-bench for the cases with this name. No rows if ptrace is not permitted, which skips the test.
std::vector<Row> measured(const std::string& only, const std::string& runs = "1") {
    const auto file =
        std::filesystem::temp_directory_path() / ("path-test-" + std::to_string(getpid()) + ".json");
    const auto result = tandem::process::run_command(
        {BENCH_PROGRAM, "--only", only, "--quick", "--quiet", "--runs", runs, "--json", file.string()});
    INFO(result.errors);
    REQUIRE(result.exit_code() == 0);
    std::ifstream in(file);
    auto rows = test::from_json({std::istreambuf_iterator<char>(in), {}}).rows;
    std::filesystem::remove(file);
    std::erase_if(rows, [](const Row& row) {
        const bool skipped = row.skipped.find("ptrace is not permitted") != std::string::npos;
        if (skipped) TANDEM_SKIP_PART(row.id + ": " + row.skipped);
        return skipped || row.subject != "path"; // a peer that is not installed has a row, too
    });
    CHECK(rows.empty() != tandem::test::skipped_because.empty()); // `only` names rows that there are
    return rows;
}

} // namespace

TEST_CASE("Allocations, locked instructions and system calls between two marks are counted") {
    const SharedFlag traced;
    ForkedChildren children;
    children.start([&] { run_known_operations(traced.value()); });
    Tracer tracer;
    try {
        tracer.attach(children.last_pid());
    } catch (const std::runtime_error& failure) {
        TANDEM_SKIP(failure.what());
    }
    traced.value() = 1;
    PathTrace trace = PathRecorder(tracer).record_sender();
    const PathCounts counts = trace.counts();
    CHECK(counts.allocations == 1);
    CHECK(counts.locked >= 2); // malloc() itself executes none in a process with one thread
    CHECK(counts.system_calls == 1);
    CHECK(counts.code_pages >= 2); // this program and the C library
    CHECK(counts.code_lines >= counts.code_pages);
    CHECK(counts.instructions >= counts.code_lines);
    std::string functions;
    for (const std::string& line : trace.functions()) functions += line + "\n";
    CHECK_THAT(functions, Catch::Contains("libc.so.6 malloc") && Catch::Contains(" test_bench_path ") &&
                              Catch::Contains(": system call " + std::to_string(SYS_getppid)));
}

TEST_CASE("A message takes the same instructions in each run") {
    for (const Row& row : measured("path/minimal-ring,path/opros-to-rtm/48", "2")) {
        INFO(row.id << ": " << row.skipped);
        REQUIRE(row.runs.size() == 2);
        CHECK(row.runs[0] == row.runs[1]);
        REQUIRE(row.path_counts);
        CHECK(row.path_counts->instructions == row.runs[1]);
        if (row.group != "baseline") continue;
        CHECK((row.path_counts->allocations == 0 && row.path_counts->locked == 0 &&
               row.path_counts->system_calls == 0));
    }
}

// The bounds apply to the optimized build by g++; other presets and clang have more instructions on each path.
#if defined(TANDEM_RELEASE) && !defined(__clang__)

namespace {

struct Bound {
    const char* id;
    std::uint32_t instructions, code_lines, code_pages, allocations, locked;
};

// Instructions and code lines are 5 to 10 % above the larger count of g++ 12 and g++ 14. Code pages are 3 above it, because they
// depend on where the linker puts each function, and any change of a library moves functions. A worker's answer takes one locked
// instruction more in some runs, and up to 80 instructions.
constexpr Bound bounds[] = {
    {"tandem/path/opros-to-rtm/48/sender", 300, 29, 12, 0, 0},
    {"tandem/path/opros-to-rtm/48/receiver", 395, 38, 9, 0, 1},
    {"tandem/path/opros-to-rtm/8/caller", 1550, 126, 26, 0, 8}, // 240 of them publish which callback may hang
    {"tandem/path/opros-to-rtm/8/worker", 1760, 170, 43, 0, 13},
    {"tandem/path/rtm-to-opros/48/sender", 285, 25, 7, 0, 0},
    {"tandem/path/rtm-to-opros/48/receiver", 370, 42, 12, 0, 1},
    {"tandem/path/rtm-to-opros/8/caller", 1500, 142, 34, 0, 10},
    {"tandem/path/rtm-to-opros/8/worker", 1070, 105, 25, 0, 12},
    {"tandem/path/inside-opros/48/sender", 290, 28, 11, 0, 0},
    {"tandem/path/inside-opros/48/receiver", 300, 33, 11, 0, 1},
    {"tandem/path/inside-opros/8/caller", 48, 10, 5, 0, 0},
    {"tandem/path/inside-rtm/48/sender", 370, 44, 14, 0, 2},
    {"tandem/path/inside-rtm/48/receiver", 430, 50, 14, 0, 4},
    {"tandem/path/inside-rtm/8/caller", 29, 5, 6, 0, 0},
};

} // namespace

TEST_CASE("No side of a road has become longer") {
    const std::vector<Row> rows = measured("tandem/path/");
    if (!tandem::test::mutexes_have_owners())
        TANDEM_SKIP_PART("membarrier(2) is not permitted: locked instructions are not checked");
    for (const Bound& bound : bounds) {
        const auto row =
            std::find_if(rows.begin(), rows.end(), [&](const Row& each) { return each.id == bound.id; });
        if (rows.empty()) continue; // ptrace is not permitted
        INFO(bound.id << "; tandem-bench --only " << bound.id << " --path-functions");
        REQUIRE(row != rows.end());
        INFO(row->skipped);
        REQUIRE(row->path_counts);
        CHECK(row->path_counts->instructions <= bound.instructions);
        CHECK(row->path_counts->code_lines <= bound.code_lines);
        CHECK(row->path_counts->code_pages <= bound.code_pages);
        CHECK(row->path_counts->allocations <= bound.allocations);
        if (tandem::test::mutexes_have_owners()) CHECK(row->path_counts->locked <= bound.locked);
        // Only a call wakes a thread.
        CHECK(row->path_counts->system_calls <= (row->bytes == sizeof(double) ? 1 : 0));
    }
    if (!rows.empty()) CHECK(rows.size() == std::size(bounds));
}

#endif
