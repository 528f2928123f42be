// SPDX-License-Identifier: Apache-2.0
// systemd-logind removes a user's files in /dev/shm when that user's last session ends, unless
// RemoveIPC=no.
// The setting is read in logind's way (logind.conf(5)): one main file, then all drop-ins in order of their
// names. A file in an earlier folder hides files with the same name in later folders. The last assignment
// wins.
#include "apps/tandem/doctor/checks.hpp"

#include <algorithm>
#include <map>
#include <sstream>

namespace tandem::doctor {
namespace {

constexpr const char* folders[] = {"/etc/systemd", "/run/systemd", "/usr/local/lib/systemd",
                                   "/usr/lib/systemd"};
constexpr uid_t max_system_uid = 999; // Debian's SYS_UID_MAX

/// Returns the existing configuration files, in ascending order of precedence.
std::vector<std::string> logind_files(const Machine& machine) {
    std::vector<std::string> found;
    for (const std::string folder : folders)
        if (found.empty() && machine.exists(folder + "/logind.conf"))
            found.push_back(folder + "/logind.conf");
    std::map<std::string, std::string> drop_ins;
    for (const std::string folder : folders) {
        std::error_code absent;
        const std::string place = folder + "/logind.conf.d";
        for (std::filesystem::directory_iterator at(machine.path(place), absent), end; !absent && at != end;
             at.increment(absent))
            if (at->path().extension() == ".conf")
                drop_ins.emplace(at->path().filename(), place + "/" + at->path().filename().string());
    }
    for (const auto& [name, file] : drop_ins) found.push_back(file);
    return found;
}

/// Returns the value of RemoveIPC in the section [Login]; "" if an empty assignment resets it to the
/// default; nullopt if the file does not assign it.
std::optional<std::string> assigned_value(const std::string& content) {
    std::optional<std::string> setting;
    std::string section;
    std::istringstream lines(content);
    for (std::string line; std::getline(lines, line);) {
        line = trim(line);
        if (!line.empty() && line.front() == '[') section = line;
        const auto equals = line.find('=');
        if (section == "[Login]" && equals != std::string::npos &&
            trim(line.substr(0, equals)) == "RemoveIPC")
            setting = trim(line.substr(equals + 1));
    }
    return setting;
}

// The words that systemd's parse_boolean() takes for false.
bool is_no(std::string setting) {
    std::transform(setting.begin(), setting.end(), setting.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return setting == "no" || setting == "n" || setting == "false" || setting == "f" || setting == "off" ||
           setting == "0";
}

} // namespace

CheckResult check_remove_ipc(const Machine& machine) {
    const std::string name = "RemoveIPC of logind";
    if (!machine.exists("/run/systemd/system")) return ok(name, "systemd is not running");
    std::string setting = "yes", from = "the default";
    for (const auto& file : logind_files(machine))
        if (const auto here = assigned_value(machine.content(file).value_or(""))) {
            setting = here->empty() ? "yes" : *here;
            from = file;
        }
    const std::string value = setting + " (" + from + ")";
    if (is_no(setting)) return ok(name, value);
    // logind does not remove files of root and other system users.
    if (machine.probed.user <= max_system_uid)
        return ok(name, value + ", but does not apply to a system user like this one");
    return warning(
        name, value,
        "segments are deleted when this user's last session ends: set RemoveIPC=no in "
        "/etc/systemd/logind.conf, or run loginctl enable-linger, or run the hosts as a system user");
}

} // namespace tandem::doctor
