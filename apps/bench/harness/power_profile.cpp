// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/harness/power_profile.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <sched.h>
#include <stdexcept>
#include <sys/prctl.h>
#include <system_error>
#include <unistd.h>

namespace tandem::bench {

namespace {

constexpr const char* latency_file = "/dev/cpu_dma_latency";

[[noreturn]] void compute_forever(int core) {
    pin_to(core);
    for (volatile std::uint64_t work = 0;;) work = work + 1;
}

} // namespace

void pin_to(int core) {
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(core, &set);
    if (sched_setaffinity(0, sizeof set, &set) != 0)
        throw std::system_error(errno, std::generic_category(), fmt::format("cannot pin to core {}", core));
}

void pin_to_all_cores() {
    cpu_set_t set;
    std::memset(&set, 0xff, sizeof set); // the kernel takes those that the process may use
    if (sched_setaffinity(0, sizeof set, &set) != 0)
        throw std::system_error(errno, std::generic_category(), "cannot unpin");
}

std::vector<int> allowed_cores() {
    cpu_set_t set;
    CPU_ZERO(&set);
    sched_getaffinity(0, sizeof set, &set);
    std::vector<int> cores;
    for (int core = 0; core < CPU_SETSIZE; ++core)
        if (CPU_ISSET(core, &set)) cores.push_back(core);
    return cores;
}

pid_t fork_child() {
    const pid_t parent = getpid();
    std::fflush(nullptr); // or the child would write it once more
    const pid_t child = fork();
    if (child < 0) throw std::system_error(errno, std::generic_category(), "cannot fork");
    if (child == 0) {
        signal(SIGINT, SIG_DFL);
        signal(SIGTERM, SIG_DFL);
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (getppid() != parent) _exit(1); // died in between
    }
    return child;
}

RegimeHold::RegimeHold(Regime regime, const Cores& cores) {
    if (regime == Regime::low_latency_idle) {
        latency_fd_ = open(latency_file, O_WRONLY | O_CLOEXEC);
        const std::int32_t microseconds = 0;
        if (latency_fd_ < 0 || write(latency_fd_, &microseconds, sizeof microseconds) != sizeof microseconds)
            throw std::system_error(errno, std::generic_category(), latency_file);
    }
    if (regime != Regime::loaded) return;
    for (int core : {cores.a, cores.b}) {
        const pid_t child = fork_child();
        if (child == 0) compute_forever(core);
        burners_.emplace_back(child);
    }
}

RegimeHold::~RegimeHold() {
    if (latency_fd_ >= 0) close(latency_fd_); // the kernel's limit ends with the file
}

std::string unmet_requirement(const Case& bench_case, const Cores& cores) {
    if (bench_case.regime == Regime::low_latency_idle && access(latency_file, W_OK) != 0)
        return fmt::format("no permission to write {}; run as root", latency_file);
    const bool needs_two = bench_case.placement != Placement::alone && bench_case.regime != Regime::same_core;
    if (needs_two && cores.a == cores.b)
        return "needs two cores, this process may use one only; widen its affinity";
    return {};
}

} // namespace tandem::bench
