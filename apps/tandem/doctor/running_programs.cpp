// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/doctor/exposure.hpp"
#include "apps/tandem/output/format.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace tandem::doctor {
namespace {

namespace fs = std::filesystem;

/// A process with its command line.
struct Program {
    std::string folder;                 ///< in /proc
    std::string command;                ///< name from the kernel
    std::vector<std::string> arguments; ///< the first one is the program

    bool has(const std::string& argument) const {
        return std::find(arguments.begin(), arguments.end(), argument) != arguments.end();
    }
};

/// Reads texts that end with a zero byte each.
std::vector<std::string> read_texts(const Machine& machine, const std::string& file) {
    std::vector<std::string> texts;
    const std::string content = machine.content(file).value_or("");
    for (std::size_t begin = 0; begin < content.size();) {
        const std::size_t end = std::min(content.find('\0', begin), content.size());
        texts.push_back(content.substr(begin, end - begin));
        begin = end + 1;
    }
    return texts;
}

Program read_program(const Machine& machine, pid_t pid) {
    Program program{fmt::format("/proc/{}", pid), {}, {}};
    program.command =
        command::replace_nonprintable(machine.first_line(program.folder + "/comm").value_or(""));
    program.arguments = read_texts(machine, program.folder + "/cmdline");
    return program;
}

/// Returns how the program was started. A relative name of a file is one in its working folder.
RTC::ManagerStart start_of(const Machine& machine, const Program& program) {
    RTC::ManagerStart start{program.arguments, {}, {}};
    const std::string variable = "RTC_MANAGER_CONFIG=";
    for (const std::string& setting : read_texts(machine, program.folder + "/environ"))
        if (setting.starts_with(variable)) start.conf_variable = setting.substr(variable.size());
    start.path_of = [&machine, folder = program.folder](const std::string& file) {
        return fs::path(file).is_absolute() ? machine.path(file) : machine.path(folder + "/cwd") / file;
    };
    return start;
}

std::vector<CheckResult> check_rtm_program(const Machine& machine, const Program& program,
                                           const std::string& name, const std::vector<TcpEndpoint>& endpoints,
                                           const ReadSettings& read_settings) {
    try {
        return check_rtm_host(name, read_settings(start_of(machine, program)), endpoints);
    } catch (const std::runtime_error& error) {
        auto results = check_rtm_host(name, {}, endpoints);
        results.push_back(
            warning(name + ": settings", "unknown",
                    "they cannot be read: " + command::replace_control_characters(error.what())));
        return results;
    }
}

CheckResult check_monitor(const Program& program, const std::string& name, const TcpEndpoint& endpoint) {
    const bool control = program.has("--control");
    if (!endpoint.is_for_machines)
        return ok(name, endpoint.address + ", every user of this machine can read" +
                            (control ? ", and control with the token" : ""));
    return warning(
        name,
        endpoint.address + ", every machine that reaches it can read" +
            (control ? ", and control with the token" : ""),
        "names and values of the links need no password, and the token is not encrypted: use --bind "
        "127.0.0.1 and a tunnel (ssh -L)");
}

/// OpenRTM-aist's managers, name servers and other CORBA servers.
CheckResult check_corba_server(const std::string& name, const TcpEndpoint& endpoint) {
    if (!endpoint.is_for_machines)
        return warning(name, endpoint.address + ", every user of this machine",
                       "it is not an rtm_host of Tandem and may accept all clients: run its components in "
                       "rtm_host, which refuses other users");
    return warning(
        name, endpoint.address + ", every user and every machine that reaches it",
        "it is not an rtm_host of Tandem and may accept all clients: run its components in rtm_host, "
        "or set corba.endpoints to 127.0.0.1");
}

bool has_omniorb(const Machine& machine, const Program& program) {
    return machine.content(program.folder + "/maps").value_or("").find("libomniORB4.so") != std::string::npos;
}

} // namespace

std::vector<CheckResult> check_running_programs(const Machine& machine, const ReadSettings& read_settings) {
    std::vector<CheckResult> results;
    for (const auto& [pid, endpoints] : listening_processes(machine)) {
        const Program program = read_program(machine, pid);
        const std::string name = fmt::format("{} (pid {})", program.command, pid);
        if (program.command == "rtm_host") {
            for (auto& result : check_rtm_program(machine, program, name, endpoints, read_settings))
                results.push_back(std::move(result));
        } else if (program.command == "tandem" && program.has("monitor")) {
            for (const auto& endpoint : endpoints)
                results.push_back(
                    check_monitor(program, fmt::format("tandem monitor (pid {})", pid), endpoint));
        } else if (has_omniorb(machine, program)) {
            for (const auto& endpoint : endpoints) results.push_back(check_corba_server(name, endpoint));
        }
    }
    if (results.empty())
        results.push_back(ok("open TCP ports", "none: no host, manager or monitor of this user has one"));
    return results;
}

} // namespace tandem::doctor
