// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/commands.hpp"
#include "apps/tandem/opros/port_faults.hpp"
#include "apps/tandem/opros/probe_tasks.hpp"
#include "apps/tandem/opros/type_faults.hpp"
#include "apps/tandem/text.hpp"
#include "host/opros/engine/load/load_component.hpp"
#include "host/opros/engine/profile/flatten_composites.hpp"
#include "host/opros/engine/profile/start_order.hpp"

#include <fmt/format.h>
#include <functional>

namespace tandem::command {
namespace {

using engine::ApplicationProfile;

/// What has been found so far: one line each.
class Faults {
  public:
    /// Whether the step went without an error; its line is kept otherwise.
    bool passes(const std::function<void()>& step) {
        try {
            step();
            return true;
        } catch (const std::runtime_error& error) {
            lines.emplace_back(error.what());
            return false;
        }
    }
    std::vector<std::string> lines;
};

/// Where its profile does not fit it. Throws when there is no component to run.
std::vector<std::string> check_component(const ApplicationProfile& application,
                                         const engine::Subcomponent& entry, const LookOptions& options) {
    auto dirs = options.plugin_dirs;
    dirs.insert(dirs.begin(), application.location.file.parent_path());
    const auto file = entry.file.empty()
                          ? engine::find_component_profile(application, entry, options.plugin_dirs)
                          : entry.file;
    const auto profile = engine::read_component_profile(file);
    const auto library = engine::find_component_library(profile, dirs);
    try {
        engine::require_opros_component(library);
        auto faults = port_faults(profile, described(library, file, options)["ports"], options.initialize);
        for (std::string& each : type_faults(profile)) faults.push_back(std::move(each));
        return faults;
    } catch (const plugin::Error& error) {
        throw engine::SetupError(profile.library_location, error.what());
    }
}

std::string counted(std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

int report(const ApplicationProfile& application, const Faults& faults, bool as_json) {
    const int code = faults.lines.empty() ? 0 : 1;
    if (as_json) {
        print_json({{"application", application.name},
                    {"components", application.subcomponents.size()},
                    {"connections", application.connections.size()},
                    {"faults", faults.lines}});
        return code;
    }
    for (const std::string& line : faults.lines) print_text(line + "\n");
    print_text(application.name + ": " +
               (faults.lines.empty() ? counted(application.subcomponents.size(), "component") + " and " +
                                           counted(application.connections.size(), "connection") + " fit"
                                     : counted(faults.lines.size(), "fault")) +
               "\n");
    return code;
}

} // namespace

int opros_check(const LookOptions& options) {
    auto application = engine::read_application_profile(options.file);
    Faults faults;
    // A profile that is missing is told below, one for each component.
    if (engine::has_composites(application, options.plugin_dirs))
        application = engine::flatten_composites(application, options.plugin_dirs);
    for (const auto& connection : application.connections)
        if (!connection.error.empty())
            faults.lines.push_back(connection.location.text() + ": " + connection.error);
    const auto add = [&](const std::vector<std::string>& lines) {
        faults.lines.insert(faults.lines.end(), lines.begin(), lines.end());
    };
    std::vector<std::string> without;
    for (const auto& entry : application.subcomponents)
        if (!faults.passes([&] { add(check_component(application, entry, options)); }))
            without.push_back(entry.name);
    faults.passes([&] { engine::start_order(application); });
    faults.passes([&] { add(connection_faults(without, options)); });
    return report(application, faults, options.json);
}

} // namespace tandem::command
