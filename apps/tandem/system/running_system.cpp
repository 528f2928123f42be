// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/system/running_system.hpp"

#include "apps/tandem/opros/running/opros_hosts.hpp"
#include "host/local/local_endpoint.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

std::string proc(pid_t pid, const char* file) { return fmt::format("/proc/{}/{}", pid, file); }

bool is_rtm_host(pid_t pid) {
    std::string name;
    std::getline(std::ifstream(proc(pid, "comm")), name);
    return name == "rtm_host";
}

/// Returns the file after -f in a host's command line, else rtc.conf.
fs::path rtc_conf_of(pid_t pid) {
    std::ifstream command(proc(pid, "cmdline"), std::ios::binary);
    fs::path conf = "rtc.conf";
    for (std::string word, before; std::getline(command, word, '\0'); before = word)
        if (before == "-f") conf = word;
    return fs::read_symlink(proc(pid, "cwd")) / conf;
}

void take(pid_t& host, pid_t found, const char* program) {
    if (host != 0)
        throw std::runtime_error(fmt::format(
            "several hosts are running, {0} {1} and {0} {2}; name one of each model with --host PID", program,
            host, found));
    host = found;
}

} // namespace

RunningSystem find_running_system(const std::vector<pid_t>& pids) {
    const auto wanted = [&](pid_t pid) {
        return pids.empty() || std::find(pids.begin(), pids.end(), pid) != pids.end();
    };
    RunningSystem system;
    for (const auto& endpoint : local::find_local_endpoints(local::manager_endpoint))
        if (wanted(endpoint.pid) && is_rtm_host(endpoint.pid)) take(system.rtm, endpoint.pid, "rtm_host");
    for (const auto& host : find_opros_hosts({})) {
        if (!wanted(host.pid)) continue;
        if (!host.error.empty()) throw std::runtime_error(host.error);
        take(system.opros, host.pid, "opros_host");
        system.application = fs::read_symlink(proc(host.pid, "cwd")) / host.list.value("profile", "");
    }
    if (system.rtm != 0) system.rtc_conf = rtc_conf_of(system.rtm);
    for (const pid_t pid : pids)
        if (pid != system.rtm && pid != system.opros)
            throw std::runtime_error(fmt::format(
                "--host {}: no host of this user has this process id; tandem top lists the hosts", pid));
    if (system.rtm == 0 && system.opros == 0)
        throw std::runtime_error("no host of this user is running; start one with tandem run DIR");
    return system;
}

} // namespace tandem::command
