// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/doctor/checks.hpp"
#include "apps/tandem/output/format.hpp"
#include "host/text/join.hpp"

#include <algorithm>
#include <cerrno>
#include <set>
#include <sstream>
#include <system_error>

namespace tandem::doctor {
namespace {

// Returns whether `text` contains `word` as a whole word: "PREEMPT" is not in "PREEMPT_DYNAMIC".
bool contains_word(const std::string& text, const std::string& word) {
    std::istringstream words(text);
    for (std::string one; words >> one;)
        if (one == word) return true;
    return false;
}

/// Returns a list of cores in the kernel's notation ("2-3"); "" for none. Some kernels write "(null)" for
/// none.
std::string core_list(const Machine& machine, const std::string& file) {
    const std::string list = machine.first_line(file).value_or("");
    return list == "(null)" ? "" : list;
}

/// Returns the last value of `key` on the kernel's command line; "" if there is none.
std::string boot_option(const Machine& machine, const std::string& key) {
    std::istringstream words(machine.first_line("/proc/cmdline").value_or(""));
    std::string value;
    for (std::string word; words >> word;)
        if (word.rfind(key + "=", 0) == 0) value = word.substr(key.size() + 1);
    return value;
}

/// Returns the frequency governors of all cores; empty if the machine, usually a virtual one, does not
/// scale frequencies.
std::set<std::string> governors(const Machine& machine) {
    std::set<std::string> found;
    std::error_code absent;
    for (std::filesystem::directory_iterator at(machine.path("/sys/devices/system/cpu"), absent), end;
         !absent && at != end; at.increment(absent)) {
        const std::string core = at->path().filename();
        if (core.rfind("cpu", 0) != 0) continue;
        if (const auto governor =
                machine.first_line("/sys/devices/system/cpu/" + core + "/cpufreq/scaling_governor"))
            found.insert(*governor);
    }
    return found;
}

} // namespace

// When two hosts spin on one core, each blocks the other until the scheduler's next tick.
CheckResult check_core_count(const Machine& machine) {
    const std::string name = "cores", value = std::to_string(machine.probed.cores) + " for this process";
    if (machine.probed.cores >= 2) return ok(name, value);
    return warning(name, value,
                   "the two hosts share one core: let them wait in the kernel instead of spinning, or give "
                   "them two cores");
}

// isolcpus= removes cores from the scheduler's load balancing, so that only pinned threads run on them.
CheckResult check_isolated_cores(const Machine& machine) {
    const std::string name = "isolated cores", cores = core_list(machine, "/sys/devices/system/cpu/isolated");
    if (!cores.empty()) return ok(name, cores);
    return warning(name, "none",
                   "other processes can run on the cores of the ticks: boot with isolcpus=LIST and pin the "
                   "hosts to these cores");
}

// nohz_full= stops the scheduler's periodic tick on a core that runs a single thread.
CheckResult check_nohz_full(const Machine& machine) {
    const std::string name = "cores without timer ticks",
                      cores = core_list(machine, "/sys/devices/system/cpu/nohz_full");
    if (!cores.empty()) return ok(name, cores);
    return warning(name, "none",
                   "the kernel's tick interrupts spinning threads: boot with nohz_full=LIST, where LIST is "
                   "the isolated cores");
}

// One core with another governor is enough for a warning: a thread can run on any core.
CheckResult check_governor(const Machine& machine) {
    const std::string name = "frequency governor";
    const auto found = governors(machine);
    if (found.empty()) return ok(name, "none: this system does not control the frequency");
    const std::string value = text::join(found, ", ");
    if (found == std::set<std::string>{"performance"}) return ok(name, value);
    return warning(name, value, "an idle core starts slowly: run cpupower frequency-set -g performance");
}

// Keeping this device open with the value 0 keeps cores out of deep idle states (the kernel's PM QoS). See
// host/rt.
CheckResult check_dma_latency(const Machine& machine) {
    const std::string name = "/dev/cpu_dma_latency";
    switch (machine.probed.dma_latency_error) {
    case 0:
        return ok(name, "writable");
    case ENOENT:
        return warning(
            name, "does not exist",
            "hosts cannot use low-latency-idle: for short wake-ups, boot with cpuidle.off=1 or idle=poll");
    default:
        return warning(
            name, "not writable (" + std::generic_category().message(machine.probed.dma_latency_error) + ")",
            "hosts cannot use low-latency-idle: " +
                remedy_for_user(machine, "add a udev rule KERNEL==\"cpu_dma_latency\", GROUP=\"realtime\", "
                                         "MODE=\"0660\""));
    }
}

// A PREEMPT_DYNAMIC kernel contains all three modes; the mode is chosen at boot. debugfs shows it, but only
// to root. Otherwise the kernel's command line is the best source.
CheckResult check_preemption(const Machine& machine) {
    const std::string name = "kernel preemption",
                      remedy = "install a PREEMPT_RT kernel, or boot with preempt=full";
    const std::string version = machine.first_line("/proc/sys/kernel/version").value_or("");
    if (machine.first_line("/sys/kernel/realtime") == "1" || contains_word(version, "PREEMPT_RT"))
        return ok(name, "PREEMPT_RT");
    if (contains_word(version, "PREEMPT")) return ok(name, "full");
    if (!contains_word(version, "PREEMPT_DYNAMIC")) return warning(name, "none or voluntary", remedy);
    std::string mode = bracketed_word(machine.first_line("/sys/kernel/debug/sched/preempt").value_or(""));
    if (mode.empty()) mode = boot_option(machine, "preempt");
    if (mode == "full") return ok(name, "full");
    return warning(name, mode.empty() ? "chosen at boot, but not visible" : mode, remedy);
}

// Tandem reads the clock for every message.
CheckResult check_clock_source(const Machine& machine) {
    const std::string name = "clock source";
    const std::string value =
        machine.first_line("/sys/devices/system/clocksource/clocksource0/current_clocksource")
            .value_or("unknown");
    // The vDSO reads these clock sources in user space.
    constexpr const char* without_system_call[] = {"tsc", "kvm-clock", "hyperv_clocksource_tsc_page",
                                                   "arch_sys_counter"};
    const bool fast = std::any_of(std::begin(without_system_call), std::end(without_system_call),
                                  [&](const char* source) { return value == source; });
    if (fast) return ok(name, value);
    return warning(name, value,
                   "every time stamp takes a system call: boot with clocksource=tsc tsc=reliable if the "
                   "processor's TSC is invariant");
}

// The kernel may delay a timer by the slack, to serve several timers with one interrupt.
CheckResult check_timer_slack(const Machine& machine) {
    constexpr std::uint64_t usual = 50'000; // the kernel's default; inherited by child processes
    const std::string name = "timer slack", value = command::format_duration(machine.probed.timer_slack_ns);
    if (machine.probed.timer_slack_ns <= usual) return ok(name, value + "; 1 ns in threads that run ticks");
    return warning(name, value,
                   "sleeping threads wake late: start the hosts from a process with the usual 50 us");
}

// On x86, a hypervisor sets the CPUID bit "hypervisor" for its guests. DMI names its vendor and product, if
// readable. The kernel lists the bits of other processors as "Features", and none of them says so.
CheckResult check_hypervisor(const Machine& machine) {
    const std::string name = "hypervisor", cpu = machine.content("/proc/cpuinfo").value_or("");
    const auto flags = cpu.find("\nflags");
    if (flags == std::string::npos) return ok(name, "unknown: /proc/cpuinfo does not say");
    if (!contains_word(cpu.substr(flags, cpu.find('\n', flags + 1) - flags), "hypervisor"))
        return ok(name, "none detected");
    std::string which = machine.first_line("/sys/class/dmi/id/sys_vendor").value_or("");
    if (const auto product = machine.first_line("/sys/class/dmi/id/product_name"))
        which += (which.empty() ? "" : " ") + *product;
    return warning(name, which.empty() ? "yes" : command::replace_nonprintable(which),
                   "the hypervisor can take a core away at any time, and waking a halted core costs a VM "
                   "exit: measure on bare metal, or pin virtual cores and poll in the guest (haltpoll)");
}

} // namespace tandem::doctor
