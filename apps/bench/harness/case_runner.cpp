// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/harness/case_runner.hpp"

#include "apps/bench/harness/forked_children.hpp"
#include "apps/bench/machine/machine_conditions.hpp"

#include <algorithm>
#include <boost/interprocess/anonymous_shared_memory.hpp>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <mqueue.h>
#include <sstream>
#include <string>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>

namespace tandem::bench {
namespace {

/// The share of the machine that other processes have used since construction: the busy time of all cores
/// without that of this process and of its children that have ended. The resolution is the kernel's tick, 10
/// ms.
class MachineLoad {
  public:
    MachineLoad() : start_(read()) {}
    /// Returns 0 to 1 of the time of all cores.
    double foreign_cpu_share() const {
        const Reading now = read();
        // The sums are read one after the other, so a small negative difference counts as 0.
        const double total = now.total - start_.total;
        if (total <= 0) return 0;
        return std::max(0.0, (now.busy - start_.busy - (now.own - start_.own)) / total);
    }

  private:
    struct Reading {
        double busy, total, own; // seconds of CPU time since boot; own: of this process and its children
    };
    static Reading read() {
        Reading now{};
        // The first line of /proc/stat is the sum over all cores (proc(5)): cpu user nice system idle iowait
        // irq softirq steal, in ticks. Columns 3 and 4 are the idle time. Steal counts as busy, because another
        // guest of the hypervisor disturbs a measurement as another process does.
        std::ifstream stat("/proc/stat");
        std::string label;
        stat >> label;
        const double tick = 1.0 / static_cast<double>(sysconf(_SC_CLK_TCK));
        for (int column = 0; column < 8; ++column) {
            double ticks = 0;
            stat >> ticks;
            now.total += ticks * tick;
            if (column != 3 && column != 4) now.busy += ticks * tick;
        }
        for (int processes : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
            rusage usage{};
            getrusage(processes, &usage);
            for (const timeval& time : {usage.ru_utime, usage.ru_stime})
                now.own += static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
        }
        return now;
    }
    Reading start_;
};

constexpr std::size_t memory_bytes = std::size_t{64} << 20U;

/// Anonymous memory that forked children share with the driver; the kernel provides each page at its first use.
class SharedMemory {
  public:
    explicit SharedMemory(std::size_t bytes) : region_(boost::interprocess::anonymous_shared_memory(bytes)) {}
    std::span<std::byte> bytes() const {
        return {static_cast<std::byte*>(region_.get_address()), region_.get_size()};
    }

  private:
    boost::interprocess::mapped_region region_;
};

/// One attempt to measure a case: the data that the driver and both sides share, and the work of each side.
class CaseRun {
  public:
    CaseRun(const Case& bench_case, const Budget& budget, const Cores& cores)
        : case_(bench_case), budget_(budget), cores_(cores), name_(fresh_name()),
          // 64 more than budgeted, for results that are not samples of the loop (windows, counts).
          control_memory_(sizeof(Control) + (budget.samples + 64) * sizeof(double)), memory_(memory_bytes) {}

    const std::string& name() const { return name_; }
    Control& control() const { return *reinterpret_cast<Control*>(control_memory_.bytes().data()); }

    // [child] Not _exit(): some middleware releases its shared resources in destructors of static objects.
    [[noreturn]] void run_side_and_exit(Session::Role role) const { std::exit(run_side(role) ? 0 : 1); }

    // [child] Runs both sides as threads. _exit(), because static destructors must not run while a thread still
    // works.
    [[noreturn]] void run_both_sides_and_exit() const {
        std::thread second([&] {
            if (!run_side(Session::Role::b)) _exit(1);
        });
        if (!run_side(Session::Role::a)) _exit(1);
        second.join();
        _exit(0);
    }

  private:
    /// The names of segments, queues and sockets of a case contain it, so that leftovers can be found.
    static std::string fresh_name() {
        static int number = 0;
        return fmt::format("tandem-bench-{}-{}", getpid(), number++);
    }

    /// Returns true on success; otherwise the text of the exception is in the control block.
    bool run_side(Session::Role role) const {
        const bool b = role == Session::Role::b;
        try {
            pin_to(b && case_.placement != Placement::same_core ? cores_.b : cores_.a);
            Session session(case_, budget_, role, name_, control(), memory_.bytes());
            case_.run(session);
            return true;
        } catch (const std::exception& failure) {
            // The memory is zero at first: one byte less than there is room for, so the text ends with a zero.
            std::strncpy(control().failure[b ? 1 : 0], failure.what(), Control::text_bytes - 1);
            return false;
        }
    }

    const Case& case_;
    const Budget& budget_;
    Cores cores_;
    std::string name_;
    SharedMemory control_memory_, memory_;
};

/// Removes what a killed side has left: files whose names contain the case's name, and its message queues.
void remove_leftovers(const std::string& name) {
    std::error_code ignored; // another program's file may vanish between listing and removal
    for (const auto& folder : {std::filesystem::path("/dev/shm"), std::filesystem::temp_directory_path()})
        for (const auto& file : std::filesystem::directory_iterator(folder, ignored))
            if (file.path().filename().string().find(name) != std::string::npos)
                std::filesystem::remove_all(file.path(), ignored);
    for (const char* suffix : {"-0", "-1"}) mq_unlink(("/" + name + suffix).c_str());
}

void start_sides(ForkedChildren& children, const CaseRun& run, Placement placement) {
    if (placement == Placement::threads) return children.start([&] { run.run_both_sides_and_exit(); });
    children.start([&] { run.run_side_and_exit(Session::Role::a); });
    if (placement != Placement::alone) children.start([&] { run.run_side_and_exit(Session::Role::b); });
}

} // namespace

Outcome run_case(const Case& bench_case, const Budget& budget, const Cores& cores) {
    Outcome outcome;
    const CaseRun run(bench_case, budget, cores);
    { // children and conditions end with this scope, before their leftovers are removed
        const MachineConditions conditions(bench_case, cores);
        const MachineLoad load;
        ForkedChildren children;
        start_sides(children, run, bench_case.placement);
        outcome.failure = children.wait(budget.timeout_seconds + bench_case.extra_seconds);
        // Otherwise the load of a loaded case would count as load of other processes.
        if (!bench_case.loaded) outcome.foreign_cpu_share = load.foreign_cpu_share();
    }
    remove_leftovers(run.name());
    Control& control = run.control();
    for (const char* text : control.failure) // this text says more than "side A failed"
        if (*text != '\0') outcome.failure = text;
    if (control.has_tick_counts) outcome.tick_counts = control.tick_counts;
    if (control.has_window_counts) outcome.window_counts = control.window_counts;
    if (control.has_path_counts) outcome.path_counts = control.path_counts;
    std::istringstream functions(control.path_functions);
    for (std::string line; std::getline(functions, line);) outcome.path_functions.push_back(line);
    if (outcome.failure.empty())
        outcome.samples.assign(control.samples(), control.samples() + control.sample_count.load());
    return outcome;
}

} // namespace tandem::bench
