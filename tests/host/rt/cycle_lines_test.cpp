// SPDX-License-Identifier: Apache-2.0
#include "host/rt/cycle_lines.hpp"
#include "host/rt/periodic_tick.hpp"
#include "host/rt/rehearsal.hpp"
#include "host/rt/shared_tick.hpp"
#include "tests/support/skip.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <atomic>
#include <optional>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

using namespace std::chrono_literals;
using tandem::rt::CycleLines;
using tandem::rt::SharedTick;

namespace {

/// Returns how many instructions a process executes for the work; nothing if it must not be traced.
template <class Work>
std::optional<long> count_instructions(const Work& work) {
    const pid_t child = fork();
    if (child == 0) {
        if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(1);
        raise(SIGSTOP);
        work();
        _exit(0);
    }
    int status = 0;
    long steps = 0;
    while (waitpid(child, &status, 0) == child && WIFSTOPPED(status)) {
        ptrace(PTRACE_SINGLESTEP, child, nullptr, nullptr);
        ++steps;
    }
    return steps > 1 ? std::optional(steps) : std::nullopt;
}

struct Component {
    virtual ~Component() = default;
    std::array<std::byte, 2048> memory{};
};

} // namespace

// GCC takes a function that only prefetches for one without effect.
TEST_CASE("the compiler does not omit the requests for lines") {
    CycleLines noted, none;
    std::array<std::byte, 8192> object{};
    const long lines = CycleLines::most_runs * CycleLines::longest_run;
    for (std::size_t i = 0; i < CycleLines::most_runs; ++i) noted.add(object.data(), object.size());
    const auto instructions = [](const std::vector<const CycleLines*>& next) {
        return count_instructions([&] {
            if (!next.empty()) next.front()->prefetch();
        });
    };
    const auto without = instructions({&none}), with = instructions({&noted});
    if (!without || !with) TANDEM_SKIP("this process must not trace another one");
    CHECK(*with - *without >= lines);

    const Component component;
    const auto do_nothing = count_instructions([] {}),
               prefetch = count_instructions([&] { tandem::rt::prefetch(component); });
    REQUIRE((do_nothing && prefetch));
    CHECK(*prefetch - *do_nothing >= static_cast<long>(2 * sizeof component.memory / CycleLines::line));
}

TEST_CASE("the lines of a cycle have a limit, and only a rehearsal that collects them adds some") {
    std::array<std::byte, 8192> object{};
    tandem::rt::note_lines(object.data(), object.size());
    CycleLines lines;
    tandem::rt::this_thread_lines = &lines;
    tandem::rt::note_lines(object.data(), 0);
    CHECK(lines.count() == 0);
    for (std::size_t i = 0; i < CycleLines::most_runs + 5; ++i)
        tandem::rt::note_lines(object.data() + i, object.size());
    tandem::rt::this_thread_lines = nullptr;
    CHECK(lines.count() == CycleLines::most_runs);
    lines.prefetch();
    lines.clear();
    CHECK(lines.count() == 0);
}

TEST_CASE("a shared tick rehearses its cycle once in 64 rounds, and its cycles are not rehearsals") {
    std::atomic<int> cycles{0}, rehearsals{0}, wrong{0}, too_early{0};
    std::int64_t rehearsed = 0;
    const auto is_rehearsal = [] {
        return tandem::rt::rehearsing() && tandem::rt::this_thread_lines != nullptr;
    };
    const auto tick = SharedTick::start({1ms, {}, {}},
                                        {[&](const tandem::rt::ArrivedTick& arrived) {
                                             wrong += is_rehearsal() ? 1 : 0;
                                             too_early += arrived.now < rehearsed ? 1 : 0;
                                             ++cycles;
                                             return SharedTick::Next::tick;
                                         },
                                         [&] {
                                             wrong += is_rehearsal() ? 0 : 1;
                                             ++rehearsals;
                                             rehearsed = tandem::rt::monotonic_ns();
                                         },
                                         "cell", [](const std::string&) {}},
                                        SharedTick::Next::tick);
    for (int i = 0; i < 10'000 && cycles < 200; ++i) std::this_thread::sleep_for(1ms);
    CHECK(tick->leave(1h));
    CHECK(cycles >= 200);
    CHECK(rehearsals >= cycles / 64 - 1);
    CHECK(rehearsals <= cycles / 64 + 1);
    CHECK(wrong == 0);
    CHECK(too_early == 0); // the cycle's duration excludes the rehearsal
}
