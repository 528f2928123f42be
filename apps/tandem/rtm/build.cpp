// SPDX-License-Identifier: Apache-2.0
// Builds an RT-Component from its folder, under the name that its module function gives.
#include "apps/tandem/build/component_folder.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/rtm/commands.hpp"
#include "apps/tandem/rtm/module_names.hpp"

#include <stdexcept>

namespace tandem::command {
namespace {

// The module to build. Its name is that of the library, because rtm_host loads NAME.so by calling NAMEInit().
std::string select_module(const RtmBuildOptions& options) {
    if (!options.name.empty()) return options.name;
    const auto modules = find_module_names(options.folder);
    if (modules.size() == 1) return *modules.begin();
    if (modules.empty())
        throw std::runtime_error(
            "no source in " + options.folder.string() +
            " nor below it defines a module function, void NAMEInit(RTC::Manager*); "
            "name the module with --name NAME if a macro or an included file defines it");
    std::string names;
    for (const auto& each : modules) names += (names.empty() ? "" : ", ") + each;
    throw std::runtime_error(options.folder.string() + " has the modules " + names +
                             "; choose one with --name NAME");
}

} // namespace

int rtm_build(const RtmBuildOptions& options) {
    require_folder(options.folder);
    const std::string name = select_module(options);
    // Also for a name that was found: it becomes the name of a file and of a CMake target.
    require_component_name(name);
    print_text(build_plugin("rtm", name, name + "Init", options, options.folder).string() + "\n");
    return 0;
}

} // namespace tandem::command
