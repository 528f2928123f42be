// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/run/run_folder.hpp"

#include "apps/tandem/build/folder/source_text.hpp"
#include "host/opros/engine/profile/profile_kind.hpp"
#include "host/opros/engine/profile/setup_error.hpp"

#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

// Of the profiles in a folder, those of applications. A file that is no profile is none of them.
std::vector<fs::path> application_profiles(const fs::path& folder) {
    std::vector<fs::path> found;
    for (const auto& file : list_files(folder)) {
        if (file.extension() != ".xml") continue;
        try {
            if (engine::read_profile_kind(file) == engine::ProfileKind::application) found.push_back(file);
        } catch (const engine::SetupError&) {
            continue;
        }
    }
    return found;
}

} // namespace

RunFolder find_run_folder(const fs::path& folder) {
    if (!fs::is_directory(folder)) throw std::runtime_error(folder.string() + " is no folder");
    const fs::path whole = fs::canonical(folder);
    const auto applications = application_profiles(whole / "opros");
    if (applications.size() > 1) {
        std::string names;
        for (const auto& each : applications) names += (names.empty() ? "" : ", ") + each.filename().string();
        throw std::runtime_error((whole / "opros").string() + " has several applications: " + names +
                                 "; leave one of them there");
    }
    RunFolder found;
    if (!applications.empty()) found.application = applications.front();
    if (fs::is_regular_file(whole / "rtm" / "rtc.conf")) found.rtc_conf = whole / "rtm" / "rtc.conf";
    if (found.application.empty() && found.rtc_conf.empty())
        throw std::runtime_error(
            whole.string() +
            " has neither an application profile in opros/ nor rtm/rtc.conf; tandem link profile A B "
            "--output DIR writes both for two components");
    return found;
}

std::vector<hosts::HostCommand> host_commands(const RunFolder& folder, const RunOptions& options) {
    const fs::path programs = fs::read_symlink("/proc/self/exe").parent_path();
    std::vector<std::string> common{"--parent-death"}; // no host outlives this program, even if it is killed
    for (const auto& dir : options.plugin_dirs)
        common.insert(common.end(), {"--plugin-path", fs::absolute(dir).string()});
    common.insert(common.end(), options.host_arguments.begin(), options.host_arguments.end());
    std::vector<hosts::HostCommand> commands;
    const auto add = [&](const char* name, std::vector<std::string> arguments,
                         const fs::path& configuration) {
        arguments.insert(arguments.begin(), (programs / name).string());
        arguments.insert(arguments.end(), common.begin(), common.end());
        // The libraries of a host that was ready were tried before; trying them takes half of a restart.
        commands.push_back({name, arguments, "", configuration.parent_path().string(), {"--no-probe"}});
    };
    if (!folder.rtc_conf.empty()) add("rtm_host", {"-f", folder.rtc_conf.string()}, folder.rtc_conf);
    if (!folder.application.empty()) {
        std::vector<std::string> arguments{folder.application.string()};
        if (options.strict) arguments.emplace_back("--strict");
        add("opros_host", arguments, folder.application);
    }
    return commands;
}

} // namespace tandem::command
