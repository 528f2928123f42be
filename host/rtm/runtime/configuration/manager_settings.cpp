// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/configuration/manager_settings.hpp"
#include "host/rtm/runtime/configuration/command_line.hpp"
#include "host/rtm/runtime/configuration/conf_file.hpp"
#include <cstdlib>

namespace RTC {
namespace {

namespace fs = std::filesystem;

CommandLine parse_arguments(std::vector<std::string> arguments) {
    std::vector<char*> words;
    words.reserve(arguments.size());
    for (auto& argument : arguments) words.push_back(argument.data());
    return parse_command_line(static_cast<int>(words.size()), words.data());
}

// Returns the file that is read without -f: the first of the places of OpenRTM-aist's ManagerConfig::findConfigFile().
// Returns an empty string if there is none.
std::string find_default_conf_file(const ManagerStart& start) {
    if (start.conf_variable) return *start.conf_variable;
    for (const char* file : {"./rtc.conf", "/etc/rtc.conf", "/etc/rtc/rtc.conf"})
        if (fs::exists(fs::symlink_status(start.path_of(file)))) return file; // also a link to nothing
    return "";
}

} // namespace

ManagerStart start_of_this_process(std::vector<std::string> arguments) {
    ManagerStart start{std::move(arguments), {}, [](const std::string& file) { return fs::path(file); }};
    if (const char* const named = std::getenv("RTC_MANAGER_CONFIG")) start.conf_variable = named;
    return start;
}

std::string read_manager_settings(const ManagerStart& start, coil::Properties& config,
                                  SettingOrigins& origins) {
    const CommandLine line = parse_arguments(start.arguments);
    std::string file = line.conf_file.empty() ? find_default_conf_file(start) : line.conf_file;
    if (line.conf_file_may_be_missing && !fs::exists(start.path_of(file))) file.clear();
    if (!file.empty()) {
        read_conf_file(start.path_of(file), config, &origins);
        config.setProperty("config_file", file);
    }
    config << line.settings;
    for (const auto& [key, origin] : line.origins) origins[key] = origin;
    return file;
}

} // namespace RTC
