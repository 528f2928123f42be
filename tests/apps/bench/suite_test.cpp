// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/measurements/measurements.hpp"
#include "apps/bench/suite.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <set>
#include <sys/mman.h>
#include <sys/wait.h>

using namespace tandem::bench;

namespace {

Case alone(const char* operation, std::function<void(Session&)> run) {
    Case entry;
    entry.subject = "test";
    entry.operation = operation;
    entry.placement = Placement::alone;
    entry.run = std::move(run);
    return entry;
}

Report measured(std::vector<Case> cases, double timeout = 10) {
    Plan plan;
    plan.cases = std::move(cases);
    plan.budget.timeout_seconds = timeout;
    plan.budget.attempts = 1;
    plan.cores.a = plan.cores.b = allowed_cores().front();
    plan.progress = false;
    return measure(plan);
}

} // namespace

TEST_CASE("Every case has a unique name and the cases with one comparison key are neighbours") {
    const Registry registry = all_cases();
    std::set<std::string> ids, closed;
    std::string key;
    for (const Case& entry : registry.cases) {
        CHECK(ids.insert(entry.id()).second);
        if (entry.comparison_key() != key) {
            INFO(entry.comparison_key());
            CHECK(closed.insert(key = entry.comparison_key()).second);
        }
    }
}

TEST_CASE("Cases are selected by any of several parts of their names") {
    const auto all = all_cases().cases;
    CHECK(selected(all, "").size() == all.size());
    CHECK(selected(all, "no such case").empty());
    const auto some = selected(all, "cache-line,call-queue");
    CHECK(!some.empty());
    for (const Case& entry : some)
        CHECK((entry.id().find("cache-line") != std::string::npos ||
               entry.id().find("call-queue") != std::string::npos));
}

TEST_CASE("The row of a case shows what a side has thrown") {
    const Report report =
        measured({alone("throws", [](Session&) { throw std::runtime_error("it broke here"); })});
    CHECK(report.rows.at(0).skipped == "it broke here");
}

TEST_CASE("A side that hangs is killed and one that crashes is named and nothing is left behind", "[alone]") {
    const Report report = measured({alone("hangs",
                                          [](Session& session) {
                                              std::ofstream("/dev/shm/" + session.name() + "-left") << "x";
                                              for (;;) pause();
                                          }),
                                    alone("crashes", [](Session&) { raise(SIGKILL); })},
                                   0.3);
    CHECK_THAT(report.rows.at(0).skipped, Catch::Contains("not finished after 0.3 s"));
    CHECK_THAT(report.rows.at(1).skipped, Catch::Contains("ended by signal"));
    CHECK(waitpid(-1, nullptr, WNOHANG) == -1); // no child
    for (const auto& file : std::filesystem::directory_iterator("/dev/shm"))
        CHECK(file.path().filename().string().find("tandem-bench-" + std::to_string(getpid())) ==
              std::string::npos);
}

TEST_CASE("A case that needs two cores says so if there is only one") {
    Case pair = alone("pair", [](Session&) {});
    pair.placement = Placement::processes;
    const Row row = measured({pair}).rows.at(0);
    CHECK_THAT(row.skipped, Catch::Contains("needs two cores"));
    CHECK(row.runs.empty());
}

TEST_CASE("After the runs the cases of missed limits are measured twice more and no others", "[alone]") {
    // In memory that the forked sides share: how often each case was measured.
    void* const memory =
        mmap(nullptr, sizeof(int[3]), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    REQUIRE(memory != MAP_FAILED);
    int* const times = static_cast<int*>(memory);
    const auto counted = [&](const char* operation, int* count, std::vector<double> results) {
        return alone(operation, [=](Session& session) { session.add_result(results.at((*count)++)); });
    };
    Plan plan;
    plan.cases = {counted("once-slow", times, {9, 1, 2}), counted("good", times + 1, {1}),
                  counted("slow", times + 2, {9, 1, 8})};
    for (const Case& entry : plan.cases)
        plan.limits.push_back({entry.operation, AcceptanceLimit::Comparison::at_most, 3, entry.id(), ""});
    plan.budget.attempts = 1;
    plan.pause_seconds = 0;
    plan.cores.a = plan.cores.b = allowed_cores().front();
    plan.progress = false;
    const Report report = measure(plan);
    CHECK(report.rows.at(0).runs == std::vector<double>{9, 1, 2});
    CHECK(report.rows.at(1).runs == std::vector<double>{1});
    CHECK(report.rows.at(2).runs == std::vector<double>{9, 1, 8});
    CHECK((report.rows[0].measured_again == 2 && report.rows[1].measured_again == 0));
    const auto results = check_acceptance(plan.limits, report);
    CHECK((results.at(0).passed() && results.at(1).passed() && results.at(2).failed()));
    munmap(memory, sizeof(int[3]));
}

TEST_CASE("Paced samples count from when they were due", "[alone]") {
    // Each exchange takes as long as three intervals: the n-th is due at n and over at 3 n, so lateness
    // grows.
    struct Slow {
        explicit Slow(Session&) {}
        void send(std::uint64_t sequence) { last = sequence; }
        std::uint64_t receive() {
            for (const std::uint64_t end = ticks() + to_ticks(3e6); ticks() < end;) {
            }
            return last;
        }
        std::uint64_t last = 0;
    };
    Clock::calibrate();
    Case entry = alone("paced", measure_paced<Slow>);
    Plan plan;
    plan.cases = {entry};
    plan.budget.samples = 20;
    plan.budget.attempts = 1;
    plan.cores.a = plan.cores.b = allowed_cores().front();
    plan.progress = false;
    const Report report = measure(plan);
    REQUIRE(report.rows.at(0).skipped.empty());
    CHECK(report.rows.at(0).summary.max >= 20 * 2e6); // and not the 3 ms that each exchange took
}
