// SPDX-License-Identifier: Apache-2.0
// Checks whether times of this machine can be compared with those of another. chronyd, ntpd,
// systemd-timesyncd, ptp4l and phc2sys report to the kernel. Without recent reports the kernel returns to
// "unsynchronized".
#include "apps/tandem/doctor/checks.hpp"
#include "apps/tandem/output/format.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

namespace tandem::doctor {
namespace {

// /proc shows at most 15 characters of a name.
constexpr std::array<std::string_view, 5> clock_programs{"phc2sys", "ptp4l", "chronyd", "ntpd",
                                                         "systemd-timesyn"};

/// Returns the running programs that set clocks, for example "ptp4l, phc2sys"; "" if there is none.
std::string running_clock_programs(const Machine& machine) {
    std::string names;
    std::error_code none;
    const std::filesystem::directory_iterator end;
    for (std::filesystem::directory_iterator it(machine.path("/proc"), none); !none && it != end;
         it.increment(none)) {
        const std::string process = it->path().filename().string();
        if (process.find_first_not_of("0123456789") != std::string::npos) continue;
        const std::string name = machine.first_line("/proc/" + process + "/comm").value_or("");
        if (std::find(clock_programs.begin(), clock_programs.end(), name) == clock_programs.end()) continue;
        if (names.find(name) == std::string::npos) names += (names.empty() ? "" : ", ") + name;
    }
    return names;
}

} // namespace

CheckResult check_clock_synchronization(const Machine& machine) {
    const std::string name = "clock synchronization", programs = running_clock_programs(machine);
    const std::string by = programs.empty() ? "" : " (" + programs + ")";
    if (machine.probed.clock_synchronized) {
        const auto error = static_cast<std::uint64_t>(std::max(0L, machine.probed.clock_max_error_us));
        return ok(name, "within " + command::format_duration(error * 1000) + by);
    }
    return warning(name, "unsynchronized" + by,
                   "matters only if the system spans several machines: their time stamps cannot be compared, "
                   "and one-way times between them are meaningless: run chrony, or linuxptp (ptp4l, phc2sys) "
                   "for microseconds");
}

} // namespace tandem::doctor
