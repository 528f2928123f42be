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

// False for a processor number that cpu_set_t cannot hold.
bool to_set(const CpuMask& mask, cpu_set_t& set) {
    CPU_ZERO(&set);
    for (unsigned int cpu : mask) {
        if (cpu >= CPU_SETSIZE) return false;
        CPU_SET(cpu, &set);
    }
    return true;
}

} // namespace

// Linux has no affinity of processes: that of the main thread, which new threads inherit, stands for it.
bool getProcCpuAffinity(CpuMask& cpu_mask) {
    cpu_set_t set;
    CPU_ZERO(&set);
    if (::sched_getaffinity(::getpid(), sizeof set, &set) != 0) return false;
    cpu_mask = numbers(set);
    return true;
}

bool setProcCpuAffinity(const CpuMask& cpu_mask) {
    cpu_set_t set;
    return to_set(cpu_mask, set) && ::sched_setaffinity(::getpid(), sizeof set, &set) == 0;
}

bool setProcCpuAffinity(const std::string& cpu_mask) {
    CpuMask mask;
    return stringTo(mask, cpu_mask.c_str()) && setProcCpuAffinity(mask);
}

bool getThreadCpuAffinity(CpuMask& cpu_mask) {
    cpu_set_t set;
    CPU_ZERO(&set);
    if (::pthread_getaffinity_np(::pthread_self(), sizeof set, &set) != 0) return false;
    cpu_mask = numbers(set);
    return true;
}

bool setThreadCpuAffinity(const CpuMask& cpu_mask) {
    cpu_set_t set;
    return to_set(cpu_mask, set) && ::pthread_setaffinity_np(::pthread_self(), sizeof set, &set) == 0;
}

bool setThreadCpuAffinity(const std::string& cpu_mask) {
    CpuMask mask;
    return stringTo(mask, cpu_mask.c_str()) && setThreadCpuAffinity(mask);
}

} // namespace coil
