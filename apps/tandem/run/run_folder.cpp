// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/run/run_folder.hpp"

#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/run/node_settings.hpp"
#include "host/opros/engine/profile/flatten_composites.hpp"
#include "host/opros/engine/profile/profile_kind.hpp"
#include "host/opros/engine/profile/setup_error.hpp"
#include "host/opros/engine/profile/xml_file.hpp"
#include "host/plugin/plugin_dirs.hpp"
#include "host/rtm/runtime/configuration/conf_check.hpp"
#include "host/rtm/runtime/configuration/conf_file.hpp"
#include "host/text/join.hpp"

#include <optional>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

std::string join_names(const std::vector<fs::path>& files) {
    return text::join(files, ", ", [](const fs::path& file) { return file.filename().string(); });
}

/// Returns the kind of a profile in the start folder of opros_host; nullopt for a component's data file.
std::optional<engine::ProfileKind> kind_of(const fs::path& file) {
    try {
        return engine::find_profile_kind(file);
    } catch (const engine::SetupError& error) {
        throw std::runtime_error(std::string(error.what()) + "; correct the file, or move it out of " +
                                 file.parent_path().string());
    }
}

/// Describes the root elements of files that are not profiles, because one of them may be mistyped.
std::string describe_roots(const std::vector<fs::path>& files) {
    std::string text;
    for (const auto& file : files) {
        const engine::XmlFile xml(file);
        text += (text.empty() ? ": " : ", ") + xml.location(xml.root()).text() + " has " +
                engine::tag(xml.root().name());
    }
    return text;
}

/// Returns the application profile in a folder; empty if the folder has no XML file. Skipping an existing application
/// would run only half of the robot.
fs::path find_application_profile(const fs::path& folder) {
    const auto files = list_entries(folder, ".xml");
    std::vector<fs::path> applications, others;
    for (const auto& file : files) {
        const auto kind = kind_of(file);
        if (kind == engine::ProfileKind::application) applications.push_back(file);
        if (!kind) others.push_back(file);
    }
    if (applications.empty() && !files.empty())
        throw std::runtime_error(folder.string() +
                                 " has XML files, but none is an application profile: expected the root "
                                 "element <package_profile> or <application_profile>" +
                                 describe_roots(others) +
                                 "; correct this, or remove the folder to run only the RTM host");
    if (applications.size() > 1)
        throw std::runtime_error(folder.string() + " has several applications: " + join_names(applications) +
                                 "; keep one of them");
    if (applications.empty()) return {};
    engine::read_application_profile(applications.front()); // throws for errors that would end opros_host
    return applications.front();
}

/// Returns the rtc.conf in a folder; empty if the folder has no configuration.
fs::path find_rtc_conf_in(const fs::path& folder, std::vector<std::string>& warnings) {
    fs::path conf = folder / "rtc.conf";
    if (!is_there(conf)) {
        const auto others = list_entries(folder, ".conf");
        if (others.empty()) return {};
        throw std::runtime_error(folder.string() + " has " + join_names(others) +
                                 ", but no rtc.conf; rename the manager's configuration to rtc.conf, or "
                                 "remove the folder to run only the OPRoS host");
    }
    coil::Properties settings;
    RTC::SettingOrigins origins;
    RTC::read_conf_file(conf, settings, &origins);
    warnings =
        RTC::check_and_normalize_settings(settings, origins); // throws for errors that would end rtm_host
    return conf;
}

} // namespace

RunFolder find_run_folder(const fs::path& folder) {
    if (!fs::is_directory(folder)) throw std::runtime_error(folder.string() + " is not a folder");
    const fs::path whole = fs::canonical(folder);
    RunFolder found{find_application_profile(whole / "opros"), {}};
    found.rtc_conf = find_rtc_conf_in(whole / "rtm", found.conf_warnings);
    if (found.application.empty() && found.rtc_conf.empty())
        throw std::runtime_error(
            whole.string() +
            " has neither an application profile in opros/ nor rtm/rtc.conf; tandem link profile A B "
            "--output DIR writes both for two components");
    return found;
}

engine::NodePart find_node_part(const RunFolder& folder, const RunOptions& options) {
    auto dirs = options.plugin_dirs;
    for (const auto& dir : plugin::default_plugin_dirs("opros")) dirs.push_back(dir);
    const auto application = engine::read_application_profile(folder.application);
    return engine::node_part(engine::flatten_composites(application, dirs), options.node);
}

namespace {

std::vector<std::string> settings_of_node(const RunFolder& folder, const RunOptions& options) {
    if (folder.application.empty()) return {};
    return node_settings(find_node_part(folder, options), folder.rtc_conf);
}

/// Returns the arguments of rtm_host; none if it has nothing to do.
std::vector<std::string> rtm_arguments(const RunFolder& folder, const RunOptions& options) {
    const auto settings = settings_of_node(folder, options);
    std::vector<std::string> arguments;
    if (!folder.rtc_conf.empty()) {
        arguments = {"-f", folder.rtc_conf.string()};
    } else if (!settings.empty()) {
        // No other rtc.conf is read: the file does not exist.
        arguments = {"-i", "-f", (folder.application.parent_path().parent_path() / "rtm/rtc.conf").string()};
    }
    for (const auto& setting : settings) arguments.insert(arguments.end(), {"-o", setting});
    return arguments;
}

} // namespace

bool has_node_connections(const RunFolder& folder, const RunOptions& options) {
    return !settings_of_node(folder, options).empty();
}

std::vector<hosts::HostCommand> host_commands(const RunFolder& folder, const RunOptions& options) {
    const fs::path programs = fs::read_symlink("/proc/self/exe").parent_path();
    std::vector<std::string> common{"--parent-death"}; // so that no host outlives this program
    for (const auto& dir : options.plugin_dirs)
        common.insert(common.end(), {"--plugin-path", fs::absolute(dir).string()});
    common.insert(common.end(), options.host_arguments.begin(), options.host_arguments.end());
    std::vector<hosts::HostCommand> commands;
    const auto add = [&](const char* name, std::vector<std::string> arguments,
                         const fs::path& configuration) {
        arguments.insert(arguments.begin(), (programs / name).string());
        arguments.insert(arguments.end(), common.begin(), common.end());
        // The host already tried its libraries before it became ready. Trying them takes half of the time of a restart.
        commands.push_back({name, arguments, "", configuration.parent_path().string(), {"--no-probe"}});
    };
    if (const auto arguments = rtm_arguments(folder, options); !arguments.empty())
        add("rtm_host", arguments, folder.rtc_conf.empty() ? folder.application : folder.rtc_conf);
    if (!folder.application.empty()) {
        std::vector<std::string> arguments{folder.application.string()};
        if (options.strict) arguments.emplace_back("--strict");
        if (!options.node.empty()) arguments.insert(arguments.end(), {"--node", options.node});
        add("opros_host", arguments, folder.application);
    }
    return commands;
}

} // namespace tandem::command
