// SPDX-License-Identifier: Apache-2.0
// systemd-logind removes what a user has in /dev/shm when that user's last session ends, unless RemoveIPC=no.
// The setting is looked up as logind does: one main file, then all drop-ins by name; a file in an earlier
// folder hides those of the same name in later ones; the last assignment counts.
#include "apps/tandem/doctor/checks.hpp"

#include <algorithm>
#include <map>
#include <sstream>

namespace tandem::doctor {
namespace {

constexpr const char* folders[] = {"/etc/systemd", "/run/systemd", "/usr/local/lib/systemd",
                                   "/usr/lib/systemd"};
constexpr uid_t last_system_user = 999;

/// The files in the order in which they count.
std::vector<std::string> files(const Machine& machine) {
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

/// The value that a file assigns in its section [Login]; empty if none.
std::optional<std::string> assigned(const std::string& content) {
    std::optional<std::string> value;
    std::string section;
    std::istringstream lines(content);
    for (std::string line; std::getline(lines, line);) {
        line = trimmed(line);
        if (!line.empty() && line.front() == '[') section = line;
        const auto equals = line.find('=');
        if (section == "[Login]" && equals != std::string::npos &&
            trimmed(line.substr(0, equals)) == "RemoveIPC")
            value = trimmed(line.substr(equals + 1));
    }
    return value;
}

bool is_no(std::string value) {
    std::transform(value.begin(), value.end(), value.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return value == "no" || value == "n" || value == "false" || value == "f" || value == "off" ||
           value == "0";
}

} // namespace

Finding check_remove_ipc(const Machine& machine) {
    const std::string name = "RemoveIPC of logind";
    if (!machine.exists("/run/systemd/system")) return ok(name, "systemd does not run here");
    std::string value = "yes", from = "the default";
    for (const auto& file : files(machine))
        if (const auto here = assigned(machine.content(file).value_or(""))) {
            value = here->empty() ? "yes" : *here;
            from = file;
        }
    const std::string seen = value + " (" + from + ")";
    if (is_no(value)) return ok(name, seen);
    if (machine.answers.user <= last_system_user)
        return ok(name, seen + ", not for a system user like this one");
    return warn(
        name, seen,
        "segments vanish when this user's last session ends: RemoveIPC=no in /etc/systemd/logind.conf, or "
        "loginctl enable-linger, or run the hosts as a system user");
}

} // namespace tandem::doctor
