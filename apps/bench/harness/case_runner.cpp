// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/harness/case_runner.hpp"

#include "apps/bench/harness/machine_load.hpp"
#include "host/process/child_process.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <mqueue.h>
#include <poll.h>
#include <sys/mman.h>
#include <system_error>
#include <thread>
#include <unistd.h>

namespace tandem::bench {

namespace {

constexpr std::size_t memory_bytes = std::size_t{64} << 20U;
volatile std::sig_atomic_t interrupt_seen = 0;

/// Anonymous memory that children inherit; pages come when they are touched.
class SharedMemory {
  public:
    explicit SharedMemory(std::size_t bytes) : bytes_(bytes) {
        at_ = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        if (at_ == MAP_FAILED)
            throw std::system_error(errno, std::generic_category(), "cannot map the memory of a case");
    }
    ~SharedMemory() { munmap(at_, bytes_); }
    SharedMemory(const SharedMemory&) = delete;
    SharedMemory& operator=(const SharedMemory&) = delete;
    std::span<std::byte> bytes() const { return {static_cast<std::byte*>(at_), bytes_}; }

  private:
    void* at_;
    std::size_t bytes_;
};

/// Everything that the sides of one case share.
struct CaseRun {
    const Case& bench_case;
    const Budget& budget;
    Cores cores;
    std::string name;
    SharedMemory control_memory, memory;

    CaseRun(const Case& c, const Budget& b, const Cores& where)
        : bench_case(c), budget(b), cores(where), name(fresh_name()),
          control_memory(sizeof(Control) + (b.samples + 64) * sizeof(double)), memory(memory_bytes) {}

    Control& control() const { return *reinterpret_cast<Control*>(control_memory.bytes().data()); }

    static std::string fresh_name() {
        static int number = 0;
        return fmt::format("tandem-bench-{}-{}", getpid(), number++);
    }

    /// [in the child] One side from beginning to end. True if it went well.
    bool run_side(Session::Role role) const {
        const bool b = role == Session::Role::b;
        try {
            pin_to(b && bench_case.regime != Regime::same_core ? cores.b : cores.a);
            Session session(bench_case, budget, role, name, control(), memory.bytes());
            bench_case.run(session);
            return true;
        } catch (const std::exception& failure) {
            std::strncpy(control().failure[b ? 1 : 0], failure.what(), Control::text_bytes - 1);
            return false;
        }
    }

    // Not _exit(): some middlewares say good-bye in the destructors of their static objects.
    [[noreturn]] void run_side_and_exit(Session::Role role) const { std::exit(run_side(role) ? 0 : 1); }

    [[noreturn]] void run_both_sides_and_exit() const {
        std::thread second([&] {
            if (!run_side(Session::Role::b)) _exit(1);
        });
        if (!run_side(Session::Role::a)) _exit(1);
        second.join();
        _exit(0);
    }
};

/// What a killed side may have left behind under the case's name.
void remove_left_overs(const std::string& name) {
    std::error_code ignored; // somebody else's file may vanish while we look
    for (const auto& folder : {std::filesystem::path("/dev/shm"), std::filesystem::temp_directory_path()})
        for (const auto& file : std::filesystem::directory_iterator(folder, ignored))
            if (file.path().filename().string().find(name) != std::string::npos)
                std::filesystem::remove_all(file.path(), ignored);
    for (const char* end : {"-0", "-1"}) mq_unlink(("/" + name + end).c_str());
}

/// Waits until all children of a case have ended. Empty if all ended well; the first that does not, an
/// interrupt or the bound ends the wait.
std::string wait_for(std::vector<process::ChildProcess>& children, double seconds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    for (;;) {
        std::vector<pollfd> fds;
        for (std::size_t i = 0; i < children.size(); ++i) {
            const auto& ended = children[i].poll();
            if (!ended)
                fds.push_back({children[i].pidfd(), POLLIN, 0});
            else if (ended->signalled)
                return fmt::format("side {} was ended by signal {}", "AB"[i], strsignal(ended->code));
            else if (!ended->success())
                return fmt::format("side {} failed", "AB"[i]);
        }
        if (fds.empty()) return {};
        const std::chrono::duration<double, std::milli> rest = end - std::chrono::steady_clock::now();
        const int changed = poll(fds.data(), fds.size(), std::max(0, static_cast<int>(rest.count())));
        if (interrupted()) return "interrupted";
        if (changed == 0) return fmt::format("not finished after {:g} s", seconds);
    }
}

template <class Work>
void start(std::vector<process::ChildProcess>& children, Work&& work) {
    const pid_t child = fork_child();
    if (child == 0) work();
    children.emplace_back(child);
}

} // namespace

void catch_interrupts() {
    struct sigaction action {};
    action.sa_handler = [](int) { interrupt_seen = 1; };
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() { return interrupt_seen != 0; }

Outcome run_case(const Case& bench_case, const Budget& budget, const Cores& cores) {
    Outcome outcome;
    const CaseRun stage(bench_case, budget, cores);
    {
        const RegimeHold hold(bench_case.regime, cores);
        const MachineLoad load;
        Children children;
        if (bench_case.placement == Placement::threads) {
            start(children, [&] { stage.run_both_sides_and_exit(); });
        } else {
            start(children, [&] { stage.run_side_and_exit(Session::Role::a); });
            if (bench_case.placement == Placement::processes)
                start(children, [&] { stage.run_side_and_exit(Session::Role::b); });
        }
        outcome.failure = children.wait(budget.timeout_seconds + bench_case.extra_seconds);
        if (bench_case.regime != Regime::loaded) outcome.foreign_cpu_share = load.foreign_cpu_share();
    }
    remove_left_overs(stage.name);
    Control& control = stage.control();
    for (const char* text : control.failure)
        if (*text != '\0') outcome.failure = text;
    if (control.has_tick_counts) outcome.tick_counts = control.tick_counts;
    if (outcome.failure.empty())
        outcome.samples.assign(control.samples(), control.samples() + control.sample_count.load());
    return outcome;
}

} // namespace tandem::bench
