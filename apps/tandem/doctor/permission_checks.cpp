// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/doctor/checks.hpp"
#include "apps/tandem/output/format.hpp"

#include <charconv>
#include <system_error>

namespace tandem::doctor {
namespace {

std::string error_text(int code) { return std::generic_category().message(code); }

std::string limit_text(std::uint64_t limit, bool bytes) {
    if (limit == unlimited) return "unlimited";
    return bytes ? command::format_bytes(limit) : std::to_string(limit);
}

/// Returns the number in the first line of a file; nullopt if there is none.
std::optional<long> number_in(const Machine& machine, const std::string& file) {
    const auto text = machine.first_line(file);
    long value = 0;
    if (!text || std::from_chars(text->data(), text->data() + text->size(), value).ec != std::errc{})
        return std::nullopt;
    return value;
}

// Two checks give this advice: the one of the limit, and the one of the action that the limit prevents.
std::string raise_memlock(const Machine& machine) {
    return remedy_for_user(machine, "set '@realtime - memlock unlimited' in /etc/security/limits.d") +
           ", or LimitMEMLOCK=infinity in the unit";
}

std::string raise_rtprio(const Machine& machine) {
    return remedy_for_user(machine, "set '@realtime - rtprio 90' in /etc/security/limits.d") +
           ", or LimitRTPRIO=90 in the unit";
}

} // namespace

std::string remedy_for_user(const Machine& machine, const std::string& by_hand) {
    return machine.exists("/etc/security/limits.d/tandem.conf") ? "run adduser USER tandem and log in again"
                                                                : by_hand;
}

CheckResult check_memlock_limit(const Machine& machine) {
    const std::string name = "RLIMIT_MEMLOCK", value = limit_text(machine.probed.memlock_limit, true);
    if (machine.probed.memlock_limit == unlimited) return ok(name, value);
    // The limit does not apply to a process with CAP_IPC_LOCK.
    if (machine.probed.lock_error == 0) return ok(name, value + ", does not limit this user");
    return warning(name, value, "hosts cannot lock their memory: " + raise_memlock(machine));
}

// Tries to lock memory instead of reading the limit, because capabilities and containers matter too.
CheckResult check_memory_locking(const Machine& machine) {
    const std::string name = "mlockall";
    if (machine.probed.lock_error == 0) return ok(name, "permitted");
    return warning(name, "refused (" + error_text(machine.probed.lock_error) + ")",
                   "memory can be swapped out, and a page fault then takes milliseconds: " +
                       raise_memlock(machine));
}

CheckResult check_rtprio_limit(const Machine& machine) {
    const std::string name = "RLIMIT_RTPRIO", value = limit_text(machine.probed.rtprio_limit, false);
    if (machine.probed.rtprio_limit >= 50) return ok(name, value);
    // The limit does not apply to a process with CAP_SYS_NICE.
    if (machine.probed.fifo_error == 0) return ok(name, value + ", does not limit this user");
    return warning(name, value, "hosts cannot use real-time priorities: " + raise_rtprio(machine));
}

CheckResult check_sched_fifo(const Machine& machine) {
    const std::string name = "SCHED_FIFO";
    if (machine.probed.fifo_error == 0) return ok(name, "permitted");
    return warning(name, "refused (" + error_text(machine.probed.fifo_error) + ")",
                   "any other process can delay a tick: " + raise_rtprio(machine) +
                       "; in a container, use docker run --cap-add SYS_NICE");
}

// The kernel stops SCHED_FIFO threads that use more than runtime out of each period, by default 95 %.
CheckResult check_realtime_throttling(const Machine& machine) {
    const std::string name = "real-time throttling";
    const auto runtime = number_in(machine, "/proc/sys/kernel/sched_rt_runtime_us");
    const auto period = number_in(machine, "/proc/sys/kernel/sched_rt_period_us").value_or(1'000'000);
    if (!runtime) return ok(name, "not in this kernel");
    if (*runtime < 0 || *runtime >= period) return ok(name, "off");
    return warning(name, std::to_string(*runtime) + " of each " + std::to_string(period) + " us",
                   "the kernel stops a spinning SCHED_FIFO thread for the rest of each period: keep spinning "
                   "threads at normal priority, or run sysctl kernel.sched_rt_runtime_us=-1");
}

CheckResult check_open_files(const Machine& machine) {
    // A host needs a few open files, plus several for each link and each CORBA connection.
    constexpr std::uint64_t few = 64, enough = 512;
    const std::string name = "RLIMIT_NOFILE", value = limit_text(machine.probed.files_limit, false);
    const std::string remedy = "run ulimit -n 1024, or set LimitNOFILE=1024 in the unit";
    if (machine.probed.files_limit < few)
        return error(name, value, "a host cannot open its links and sockets: " + remedy);
    if (machine.probed.files_limit < enough) return warning(name, value, "too few for many links: " + remedy);
    return ok(name, value);
}

// A host watches the segments of all its links with one inotify instance.
CheckResult check_inotify(const Machine& machine) {
    // The limit is per user, and desktop programs use many instances. Linux' default is 128.
    constexpr long enough = 64;
    const std::string name = "inotify", remedy = "run sysctl fs.inotify.max_user_instances=512";
    if (machine.probed.inotify_error != 0)
        return error(name, "none left (" + error_text(machine.probed.inotify_error) + ")",
                     "each host with links needs one instance: " + remedy);
    const auto instances = number_in(machine, "/proc/sys/fs/inotify/max_user_instances");
    const auto watches = number_in(machine, "/proc/sys/fs/inotify/max_user_watches");
    if (!instances || !watches)
        return warning(
            name, "limits unknown",
            "each host with links needs one instance: mount /proc, so that the limits can be read");
    const std::string value =
        std::to_string(*instances) + " instances, " + std::to_string(*watches) + " watches per user";
    if (*instances < enough || *watches < enough)
        return warning(name, value, "each host with links needs one instance: " + remedy);
    return ok(name, value);
}

} // namespace tandem::doctor
