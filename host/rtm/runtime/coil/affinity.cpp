// SPDX-License-Identifier: Apache-2.0
// On which processors the process or the calling thread may run: sched_setaffinity(2) and its thread form.
#include <coil/Affinity.h>
#include <coil/stringutil.h>
#include <pthread.h>
#include <sched.h>
#include <unistd.h>

namespace coil {
namespace {

// The processors of a set, in ascending order.
CpuMask numbers(const cpu_set_t& set) {
    CpuMask mask;
    for (unsigned int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
        if (CPU_ISSET(cpu, &set)) mask.push_back(cpu);
    return mask;
}

// Returns false for a processor number that cpu_set_t cannot hold.
bool to_set(const CpuMask& mask, cpu_set_t& set) {
    CPU_ZERO(&set);
    for (unsigned int cpu : mask) {
        if (cpu >= CPU_SETSIZE) return false;
        CPU_SET(cpu, &set);
    }
    return true;
}

// `get_set(cpu_set_t*)` and `apply_set(const cpu_set_t*)` return 0 when they have succeeded.
template <typename GetSet>
bool get_affinity(CpuMask& mask, GetSet get_set) {
    cpu_set_t set;
    CPU_ZERO(&set);
    if (get_set(&set) != 0) return false;
    mask = numbers(set);
    return true;
}

template <typename ApplySet>
bool set_affinity(const CpuMask& mask, ApplySet apply_set) {
    cpu_set_t set;
    return to_set(mask, set) && apply_set(&set) == 0;
}

} // namespace

// Linux has no affinity of processes. The affinity of the main thread, which new threads inherit, takes its place.
bool getProcCpuAffinity(CpuMask& cpu_mask) {
    return get_affinity(cpu_mask,
                        [](cpu_set_t* set) { return ::sched_getaffinity(::getpid(), sizeof *set, set); });
}

bool setProcCpuAffinity(const CpuMask& cpu_mask) {
    return set_affinity(
        cpu_mask, [](const cpu_set_t* set) { return ::sched_setaffinity(::getpid(), sizeof *set, set); });
}

bool setProcCpuAffinity(const std::string& cpu_mask) {
    CpuMask mask;
    return stringTo(mask, cpu_mask.c_str()) && setProcCpuAffinity(mask);
}

bool getThreadCpuAffinity(CpuMask& cpu_mask) {
    return get_affinity(cpu_mask, [](cpu_set_t* set) {
        return ::pthread_getaffinity_np(::pthread_self(), sizeof *set, set);
    });
}

bool setThreadCpuAffinity(const CpuMask& cpu_mask) {
    return set_affinity(cpu_mask, [](const cpu_set_t* set) {
        return ::pthread_setaffinity_np(::pthread_self(), sizeof *set, set);
    });
}

bool setThreadCpuAffinity(const std::string& cpu_mask) {
    CpuMask mask;
    return stringTo(mask, cpu_mask.c_str()) && setThreadCpuAffinity(mask);
}

} // namespace coil
