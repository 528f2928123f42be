// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/machine/cores.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <sched.h>
#include <system_error>

namespace tandem::bench {

bool pin_thread_to(pid_t thread, int core) {
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(core, &set);
    return sched_setaffinity(thread, sizeof set, &set) == 0;
}

void pin_to(int core) {
    if (!pin_thread_to(0, core))
        throw std::system_error(errno, std::generic_category(), fmt::format("cannot pin to core {}", core));
}

void pin_to_all_cores() {
    cpu_set_t set;
    std::memset(&set, 0xff, sizeof set); // the kernel reduces it to the cores that the process may use
    if (sched_setaffinity(0, sizeof set, &set) != 0)
        throw std::system_error(errno, std::generic_category(), "cannot allow all cores");
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

} // namespace tandem::bench
