// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/suite.hpp"

#include "apps/bench/harness/forked_children.hpp"
#include "apps/bench/machine/machine_conditions.hpp"
#include "host/process/child_process.hpp"

#include <cmath>
#include <cstdio>
#include <ctime>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <memory>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>
#include <sys/utsname.h>
#include <thread>
#include <unistd.h>

namespace tandem::bench {
namespace {

/// RouDi's memory pools: chunks for 64-byte, 1 MiB and 6 MiB messages. Its default has none above 4 MiB.
constexpr const char* roudi_pools = "[general]\nversion = 1\n[[segment]]\n"
                                    "[[segment.mempool]]\nsize = 256\ncount = 2000\n"
                                    "[[segment.mempool]]\nsize = 1048704\ncount = 16\n"
                                    "[[segment.mempool]]\nsize = 6291584\ncount = 16\n";

namespace fs = std::filesystem;

/// A program that a peer needs (iceoryx: RouDi). It runs while this object exists, with its log and
/// configuration in a separate temporary folder. The destructor sends SIGTERM, after 5 s SIGKILL, and removes
/// the folder.
class Daemon {
  public:
    /// Starts the program (found on PATH) and waits until its log says that it is ready. Does nothing if the
    /// name is empty. Throws std::runtime_error if the program ends, or is not ready within 10 s.
    explicit Daemon(const std::string& program) {
        if (program.empty()) return;
        std::string name = (fs::temp_directory_path() / "tandem-bench-XXXXXX").string();
        const fs::path folder = mkdtemp(name.data());
        std::ofstream(folder / "roudi.toml") << roudi_pools;
        const fs::path log = folder / "log";
        const process::FileDescriptor out(open(log.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600));
        running_ = std::make_unique<Running>(
            folder, std::vector<std::string>{program, "-c", (folder / "roudi.toml").string()}, out.get());
        const auto is_ready = [&] {
            std::ifstream text(log);
            return std::string{std::istreambuf_iterator<char>(text), {}}.find("ready for clients") !=
                   std::string::npos;
        };
        // RouDi has no other sign of being ready: a client that starts earlier would wait or give up.
        for (int i = 0; i < 1000 && !is_ready(); ++i) {
            if (running_->process.poll())
                throw std::runtime_error(
                    program +
                    " ended before it was ready; stop another instance of it (of another tandem-bench)");
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        if (!is_ready())
            throw std::runtime_error(program + " was not ready after 10 s; check the load of the machine");
    }

  private:
    struct Running {
        Running(fs::path temporary_folder, const std::vector<std::string>& command, int log)
            : folder(std::move(temporary_folder)), process(command, {-1, log, log, ""}) {}
        ~Running() {
            process.stop(std::chrono::seconds(5));
            std::error_code ignored; // leftovers in the temporary folder do no harm
            fs::remove_all(folder, ignored);
        }
        fs::path folder;
        process::ChildProcess process;
    };

    std::unique_ptr<Running> running_;
};

/// Returns the cores as in the report: "0", or "0,1".
std::string cores_text(const Case& bench_case, const Cores& cores) {
    if (bench_case.placement == Placement::alone) return std::to_string(cores.a);
    return fmt::format("{},{}", cores.a, bench_case.placement == Placement::same_core ? cores.a : cores.b);
}

/// Returns a row with everything that is known before the measurement.
Row empty_row(const Case& bench_case, const Cores& cores) {
    Row row;
    row.id = bench_case.id();
    row.group = name_of(bench_case.group);
    row.subject = bench_case.subject;
    row.operation = bench_case.operation;
    row.bytes = bench_case.bytes;
    row.wake = name_of(bench_case.wake);
    row.conditions = bench_case.conditions();
    row.power_profile = name_of(bench_case.power_profile);
    row.placement = name_of(bench_case.placement);
    row.loaded = bench_case.loaded;
    row.detail = bench_case.detail;
    row.unit = name_of(bench_case.unit);
    row.cores = cores_text(bench_case, cores);
    return row;
}

/// Repeats a case, after a pause, while other processes disturb it. The least disturbed attempt counts.
Outcome measure_undisturbed(const Case& bench_case, const Plan& plan) {
    Outcome best = run_case(bench_case, plan.budget, plan.cores);
    // During the pause, a short disturbance such as a cron job ends.
    const int attempts =
        bench_case.extra_seconds > 0 ? 1 : plan.budget.attempts; // a long case averages disturbances
    for (int i = 1; i < attempts && best.foreign_cpu_share > Row::max_foreign_cpu_share && !interrupted();
         ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(500));
        Outcome again = run_case(bench_case, plan.budget, plan.cores);
        if (again.failure.empty() &&
            (again.foreign_cpu_share < best.foreign_cpu_share || !best.failure.empty()))
            best = again;
    }
    return best;
}

/// Runs one case once. A failure is in the outcome, so that the other cases continue.
Outcome measure_once(const Case& bench_case, const Plan& plan) {
    Outcome outcome;
    try {
        const Daemon daemon(bench_case.daemon);
        return measure_undisturbed(bench_case, plan);
    } catch (const std::exception& failure) {
        outcome.failure = failure.what();
    }
    return outcome;
}

/// The results of the runs of a case so far.
struct RowRuns {
    std::vector<Summary> summaries;
    std::string failure; ///< of the last run that failed
};

/// Appends a result to row.runs, even if the run failed.
void add_run(Row& row, RowRuns& runs, Outcome outcome) {
    if (!outcome.failure.empty()) {
        runs.failure = outcome.failure;
        row.runs.push_back(NAN); // keeps the position: ratios are formed run by run
        return;
    }
    runs.summaries.push_back(summarize(std::move(outcome.samples)));
    row.runs.push_back(runs.summaries.back().p50);
    row.foreign_cpu_share = std::max(row.foreign_cpu_share, outcome.foreign_cpu_share);
    if (outcome.window_counts) {
        if (!row.window_counts) row.window_counts.emplace();
        row.window_counts->add(*outcome.window_counts);
    }
    if (outcome.path_counts) row.path_counts = outcome.path_counts;
    if (!outcome.path_functions.empty()) row.path_functions = outcome.path_functions;
    if (!outcome.tick_counts) return;
    if (!row.tick_counts) row.tick_counts.emplace();
    row.tick_counts->add(*outcome.tick_counts);
}

/// Returns a row without figures, under the name with which all cases of the peer begin.
Row skipped_row(const SkippedPeer& peer) {
    Row row;
    row.id = "peer/" + peer.subject;
    row.group = "peer";
    row.subject = peer.subject;
    row.skipped = peer.reason;
    return row;
}

/// Summarizes the runs. A case without any successful run is skipped, with the reason of the last failure.
void finish_row(Row& row, const std::vector<Summary>& summaries, const std::string& failure) {
    row.summary = median_of(summaries);
    row.skipped = !summaries.empty() ? "" : failure.empty() ? "not measured" : failure;
}

/// Pauses, because a disturbance of a guest lasts for some seconds and would affect all measurements without
/// a pause between them. Ends early after an interrupt.
void pause_for(double seconds) {
    for (int i = 0; i < seconds * 10 && !interrupted(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

/// The rows of a plan's cases, which are measured run by run. A case is identified by its index in the plan.
class Runs {
  public:
    explicit Runs(const Plan& plan) : plan_(plan), runs_(plan.cases.size()) {
        report_.machine = this_machine();
        for (const Case& entry : plan.cases) report_.rows.push_back(empty_row(entry, plan.cores));
    }
    /// Measures the cases one after the other, until an interrupt. `name` is the name of the run in the
    /// progress line: "run 1/5".
    void measure(const std::vector<std::size_t>& cases, const std::string& name, bool again) {
        for (std::size_t n = 0; n < cases.size() && !interrupted(); ++n) {
            const std::size_t i = cases[n];
            if (plan_.progress) // \r and "erase line": one line that is overwritten
                fmt::print(stderr, "\r\033[K[{}, {}/{}] {}", name, n + 1, cases.size(), report_.rows[i].id);
            // Cases that this machine cannot measure are not tried, and have no runs.
            runs_[i].failure = unmet_requirement(plan_.cases[i], plan_.cores);
            if (!runs_[i].failure.empty()) continue;
            add_run(report_.rows[i], runs_[i], measure_once(plan_.cases[i], plan_));
            report_.rows[i].measured_again += again ? 1 : 0;
        }
    }
    /// Over all runs so far.
    const Report& sum_up() {
        for (std::size_t i = 0; i < runs_.size(); ++i)
            finish_row(report_.rows[i], runs_[i].summaries, interrupted() ? "interrupted" : runs_[i].failure);
        return report_;
    }

  private:
    const Plan& plan_;
    Report report_;
    std::vector<RowRuns> runs_;
};

/// Returns the cases that these limits refer to, in the order of the plan, so that the two cases of a ratio
/// remain neighbours.
std::vector<std::size_t> cases_of(const std::vector<AcceptanceLimit>& limits, const Plan& plan) {
    std::vector<std::size_t> cases;
    for (std::size_t i = 0; i < plan.cases.size(); ++i)
        if (needed_for_acceptance(limits, plan.cases[i].id())) cases.push_back(i);
    return cases;
}

} // namespace

std::vector<Case> selected(const std::vector<Case>& cases, const std::string& patterns) {
    if (patterns.empty()) return cases;
    std::vector<Case> out;
    for (const Case& entry : cases) {
        // Several patterns select their union; an empty one, as after a last comma, selects nothing.
        std::istringstream list(patterns);
        for (std::string pattern; std::getline(list, pattern, ',');)
            if (!pattern.empty() && entry.id().find(pattern) != std::string::npos) {
                out.push_back(entry);
                break;
            }
    }
    return out;
}

// /proc/cpuinfo names some processors, but not all.
Machine this_machine() {
    Machine machine;
    utsname name{};
    uname(&name);
    machine.kernel = fmt::format("{} {} {}", name.sysname, name.release, name.machine);
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; machine.processor.empty() && std::getline(info, line);)
        if (line.rfind("model name", 0) == 0) machine.processor = line.substr(line.find(':') + 2);
    machine.cores = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
    machine.clock = Clock::name();
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    char date[32] = "";
    std::strftime(date, sizeof date, "%Y-%m-%d %H:%M:%S", localtime_r(&now, &local));
    machine.date = date;
    return machine;
}

Report measure(const Plan& plan) {
    // With a single run before, there are three values, whose median is not a value that occurred once by
    // chance.
    constexpr int times_again = 2;
    Runs runs(plan);
    std::vector<std::size_t> all(plan.cases.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    // The runs are the outer loop: see suite.hpp.
    for (int run = 1; run <= plan.runs; ++run)
        runs.measure(all, fmt::format("run {}/{}", run, plan.runs), false);
    const auto missed = cases_of(missed_limits(plan.limits, runs.sum_up()), plan);
    for (int time = 1; time <= times_again && !missed.empty(); ++time) {
        pause_for(plan.pause_seconds);
        runs.measure(missed, fmt::format("again {}/{}", time, times_again), true);
    }
    if (plan.progress) fmt::print(stderr, "\r\033[K");
    Report report = runs.sum_up();
    for (const SkippedPeer& peer : plan.skipped) report.rows.push_back(skipped_row(peer));
    return report;
}

} // namespace tandem::bench
