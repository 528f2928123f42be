// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/machine/machine_conditions.hpp"

#include "apps/bench/harness/forked_children.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdint>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>

namespace tandem::bench {

namespace {

constexpr const char* latency_file = "/dev/cpu_dma_latency";

[[noreturn]] void compute_forever(int core) {
    pin_to(core);
    for (volatile std::uint64_t work = 0;;) work = work + 1;
}

/// The kernel honours the number of microseconds written (PM QoS) while the file is open.
process::FileDescriptor hold_low_latency_idle() {
    process::FileDescriptor file(open(latency_file, O_WRONLY | O_CLOEXEC));
    const std::int32_t microseconds = 0;
    if (file.get() < 0 || write(file.get(), &microseconds, sizeof microseconds) != sizeof microseconds)
        throw std::system_error(errno, std::generic_category(), latency_file);
    return file;
}

} // namespace

MachineConditions::MachineConditions(const Case& bench_case, const Cores& cores) {
    if (bench_case.power_profile == PowerProfile::low_latency_idle) latency_file_ = hold_low_latency_idle();
    if (!bench_case.loaded) return;
    for (int core : {cores.a, cores.b}) {
        const pid_t child = fork_child();
        if (child == 0) compute_forever(core);
        load_processes_.emplace_back(child);
    }
}

std::string unmet_requirement(const Case& bench_case, const Cores& cores) {
    if (bench_case.power_profile == PowerProfile::low_latency_idle && access(latency_file, W_OK) != 0)
        return fmt::format("no permission to write {}; run as root", latency_file);
    if (bench_case.needs_two_cores() && cores.a == cores.b)
        return "needs two cores, this process may use one only; widen its affinity";
    return {};
}

} // namespace tandem::bench
