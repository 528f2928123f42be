// SPDX-License-Identifier: Apache-2.0
// Checks what is open to other users and other machines. Unlike checks.hpp, a check has one result for each thing that
// is open. A setting that opens something is a warning with the consequence, even if it is intended.
#pragma once
#include "apps/tandem/doctor/check_result.hpp"
#include "apps/tandem/doctor/machine.hpp"
#include "host/rtm/runtime/configuration/manager_start.hpp"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace tandem::doctor {

/// Values of rtc.conf by key.
using RtmSettings = std::map<std::string, std::string>;
/// Reads the settings of a running rtm_host. Throws std::runtime_error, one line, if it cannot.
using ReadSettings = std::function<RtmSettings(const RTC::ManagerStart&)>;

/// A TCP address at which a program listens, or would.
struct TcpEndpoint {
    std::string address;         ///< HOST:PORT
    bool is_for_machines = true; ///< other machines can reach it, as far as no firewall prevents it
    bool operator==(const TcpEndpoint&) const = default;
};

/// Returns the endpoints that rtm_host opens with these settings.
std::vector<TcpEndpoint> configured_endpoints(const RtmSettings& settings);
/// Says who can do what at these endpoints with these settings. `name`: of the host, begins the name of each result.
std::vector<CheckResult> check_rtm_host(const std::string& name, const RtmSettings& settings,
                                        const std::vector<TcpEndpoint>& endpoints);

/// Returns the TCP endpoints of each process that has some, by pid. Reads only processes of the machine's user.
std::map<pid_t, std::vector<TcpEndpoint>> listening_processes(const Machine& machine);
/// Says what the running hosts, managers and monitors of this user have open.
std::vector<CheckResult> check_running_programs(const Machine& machine, const ReadSettings& read_settings);

CheckResult check_segment_modes(const Machine& machine); ///< segments of this user that others may open
CheckResult check_runtime_folder(const Machine& machine);

} // namespace tandem::doctor
