// SPDX-License-Identifier: Apache-2.0
// systemd-logind removes what a user has in /dev/shm when that user's last session ends, unless RemoveIPC=no.
// The setting is looked up as logind does (logind.conf(5)): one main file, then all drop-ins by name; a file in
// an earlier folder hides those of the same name in later ones; the last assignment counts.
#include "apps/tandem/doctor/checks.hpp"

#include <algorithm>
#include <map>
#include <sstream>

namespace tandem::doctor {
namespace {

constexpr const char* folders[] = {"/etc/systemd", "/run/systemd", "/usr/local/lib/systemd",
                                   "/usr/lib/systemd"};
constexpr uid_t max_system_uid = 999; // Debian's SYS_UID_MAX

/// The configuration files that exist, those that win last.
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

/// What a file assigns to RemoveIPC in its section [Login], "" for an assignment that resets it to the default;
/// empty if the file does not name it.
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
    if (!machine.exists("/run/systemd/system")) return ok(name, "systemd does not run here");
    std::string setting = "yes", from = "the default";
    for (const auto& file : logind_files(machine))
        if (const auto here = assigned_value(machine.content(file).value_or(""))) {
            setting = here->empty() ? "yes" : *here;
            from = file;
        }
    const std::string value = setting + " (" + from + ")";
    if (is_no(setting)) return ok(name, value);
    // logind removes nothing of root and of other system users.
    if (machine.probed.user <= max_system_uid)
        return ok(name, value + ", not for a system user like this one");
    return warning(
        name, value,
        "segments vanish when this user's last session ends: RemoveIPC=no in /etc/systemd/logind.conf, or "
        "loginctl enable-linger, or run the hosts as a system user");
}

} // namespace tandem::doctor
