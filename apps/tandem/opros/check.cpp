// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/commands.hpp"
#include "apps/tandem/opros/port_mismatches.hpp"
#include "apps/tandem/opros/probe_tasks.hpp"
#include "apps/tandem/opros/type_profile_errors.hpp"
#include "apps/tandem/output/print.hpp"
#include "host/opros/engine/load/load_component.hpp"
#include "host/opros/engine/profile/flatten_composites.hpp"
#include "host/opros/engine/profile/start_order.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <functional>

namespace tandem::command {
namespace {

using engine::ApplicationProfile;

/// The errors found so far, one line each.
class ErrorList {
  public:
    /// Runs a step. True if it did not throw; otherwise what it threw has been added to the list.
    bool run_step(const std::function<void()>& step) {
        try {
            step();
            return true;
        } catch (const std::runtime_error& error) {
            lines.emplace_back(error.what());
            return false;
        }
    }
    std::vector<std::string> lines;
    std::vector<std::string> notes; ///< what need not be wrong
};

/// Where a component does not fit its profile; `notes` gets what need not be wrong. Throws if there is no component that could be connected.
std::vector<std::string> check_component(const ApplicationProfile& application,
                                         const engine::Subcomponent& entry, const InspectOptions& options,
                                         std::vector<std::string>& notes) {
    // The application's folder comes first, as in opros_host.
    auto dirs = options.plugin_dirs;
    dirs.insert(dirs.begin(), application.location.file.parent_path());
    // flatten_composites() has already found the profiles of what it has taken out of a composite.
    const auto file = entry.file.empty()
                          ? engine::find_component_profile(application, entry, options.plugin_dirs)
                          : entry.file;
    const auto profile = engine::read_component_profile(file);
    const auto library = engine::find_component_library(profile, dirs);
    try {
        engine::require_opros_component(library);
        const auto description = describe_in_child(library, file, options);
        auto errors = find_port_mismatches(profile, description["ports"], options.initialize);
        const auto add = [&](const std::vector<std::string>& lines) {
            errors.insert(errors.end(), lines.begin(), lines.end());
        };
        add(find_type_profile_errors(profile));
        add(engine::check_properties(profile, entry.properties, dirs));
        // What the application sets is not in the profile. A component may do without other properties.
        for (const auto& absent : description["absent_properties"]) {
            const auto is_it = [&](const auto& property) { return property.first == absent["name"]; };
            if (std::any_of(entry.properties.begin(), entry.properties.end(), is_it)) continue;
            (absent["misspelt"] ? errors : notes).push_back(absent["line"]);
        }
        return errors;
        // A library's own errors do not say which profile names it: the line of <library_name> is put before them.
    } catch (const plugin::Error& error) {
        throw engine::SetupError(profile.library_location, error.what());
    }
}

/// "1 error", "2 errors"
std::string count_text(std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

// The last line of the text is a summary, also of an application without errors.
// Returns the exit code: 1 if there is an error.
int print_report(const ApplicationProfile& application, const ErrorList& errors, bool as_json) {
    const int code = errors.lines.empty() ? 0 : 1;
    if (as_json) {
        print_json({{"application", application.name},
                    {"components", application.subcomponents.size()},
                    {"connections", application.connections.size()},
                    {"errors", errors.lines},
                    {"notes", errors.notes}});
        return code;
    }
    for (const auto* lines : {&errors.lines, &errors.notes})
        for (const std::string& line : *lines) print_text(line + "\n");
    print_text(application.name + ": " +
               (errors.lines.empty() ? count_text(application.subcomponents.size(), "component") + " and " +
                                           count_text(application.connections.size(), "connection") + " fit"
                                     : count_text(errors.lines.size(), "error")) +
               "\n");
    return code;
}

} // namespace

// Goes on after an error, so that one run reports all of them.
int opros_check(const InspectOptions& options) {
    auto application = engine::read_application_profile(options.file);
    ErrorList errors;
    // A missing profile is not an error here: check_component() reports each one below.
    if (engine::has_composites(application, options.plugin_dirs))
        application = engine::flatten_composites(application, options.plugin_dirs);
    for (const auto& connection : application.connections)
        if (!connection.error.empty())
            errors.lines.push_back(connection.location.text() + ": " + connection.error);
    const auto add = [&](const std::vector<std::string>& lines) {
        errors.lines.insert(errors.lines.end(), lines.begin(), lines.end());
    };
    std::vector<std::string> excluded;
    for (const auto& entry : application.subcomponents)
        if (!errors.run_step([&] { add(check_component(application, entry, options, errors.notes)); }))
            excluded.push_back(entry.name);
    // Components that cannot be run are left out, so that the connections of the others are still checked.
    errors.run_step([&] { engine::start_order(application); });
    errors.run_step([&] { add(check_connections_in_child(excluded, options)); });
    return print_report(application, errors, options.json);
}

} // namespace tandem::command
