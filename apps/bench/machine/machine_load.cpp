// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/machine/machine_load.hpp"

#include <algorithm>
#include <fstream>
#include <string>
#include <sys/resource.h>
#include <unistd.h>

namespace tandem::bench {

MachineLoad::Reading MachineLoad::read() {
    Reading now{};
    // The first line of /proc/stat is the sum over all cores (proc(5)): cpu user nice system idle iowait irq
    // softirq steal, in ticks. Columns 3 and 4 are the idle time; steal counts as busy, since another guest
    // of the hypervisor disturbs a measurement as another process does.
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

MachineLoad::MachineLoad() : start_(read()) {}

double MachineLoad::foreign_cpu_share() const {
    const Reading now = read();
    // The sums are read one after the other: a small negative difference means none.
    const double total = now.total - start_.total;
    if (total <= 0) return 0;
    return std::max(0.0, (now.busy - start_.busy - (now.own - start_.own)) / total);
}

} // namespace tandem::bench
