// SPDX-License-Identifier: Apache-2.0
// Builds the RT-Components in a folder. Each library has the name in its module function.
#include "apps/tandem/build/component_folder.hpp"
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "apps/tandem/rtm/commands.hpp"
#include "apps/tandem/rtm/modules.hpp"
#include "host/text/join.hpp"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <stdexcept>
#include <string>
#include <vector>

namespace tandem::command {
namespace {

// Selects the modules to build. A library's name must be its module's, because rtm_host loads X.so by calling XInit(),
// or rtc_init() if there is none.
std::vector<Module> select_modules(const RtmBuildOptions& options, const std::vector<Module>& all) {
    if (!options.name.empty()) {
        const auto known = std::find_if(all.begin(), all.end(),
                                        [&](const auto& module) { return module.name == options.name; });
        return {known != all.end() ? *known : Module{options.name, options.name + "Init", {}}};
    }
    if (all.empty())
        throw std::runtime_error("no source in " + options.folder.string() +
                                 " or below defines a module function void NAMEInit(RTC::Manager*); if a "
                                 "macro or an included file defines it, name the module with --name NAME");
    if (all.size() > 1 && !options.sources.sources.empty())
        throw std::runtime_error(options.folder.string() + " has the modules " +
                                 text::join(all, ", ", &Module::name) +
                                 "; choose the module for --source with --name NAME");
    return all;
}

// Builds one of the folder's modules and prints the library's path. `several`: other modules are built too.
void build_module(const Module& module, const std::vector<Module>& all, RtmBuildOptions options, bool several,
                  CMakeProjects& projects) {
    require_component_name(module.name); // it becomes the name of a file and of a CMake target
    EntryPoint entry_point{module.function};
    for (const auto& other : all) {
        if (other.name == module.name) continue;
        if (other.function == module.function)
            entry_point.source = module.source;
        else
            entry_point.others.push_back(other.function);
    }
    if (several && !options.build.empty()) options.build /= module.name;
    print_data(build_plugin("rtm", module.name, entry_point, options, options.folder, projects).string() +
               "\n");
}

} // namespace

int rtm_build(const RtmBuildOptions& options) {
    require_folder(options.folder);
    const auto all = find_modules(options.folder);
    const auto selected = select_modules(options, all);
    CMakeProjects projects(projects_folder(options), options.timeout_s);
    if (selected.size() == 1) {
        build_module(selected.front(), all, options, false, projects);
        return 0;
    }
    std::vector<Module> failed;
    for (const auto& module : selected) try {
            build_module(module, all, options, true, projects);
        } catch (const std::runtime_error& error) {
            print_note("tandem: {}\n", replace_control_characters(error.what()));
            failed.push_back(module);
        }
    if (failed.empty()) return 0;
    throw std::runtime_error(
        fmt::format("{} of the {} modules in {} were not built: {} (see the lines above)", failed.size(),
                    selected.size(), options.folder.string(), text::join(failed, ", ", &Module::name)));
}

} // namespace tandem::command
