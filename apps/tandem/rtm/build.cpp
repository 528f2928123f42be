// SPDX-License-Identifier: Apache-2.0
// Builds an RT-Component from its folder, under the name that its module function gives.
#include "apps/tandem/build/new_folder.hpp"
#include "apps/tandem/rtm/commands.hpp"
#include "apps/tandem/rtm/module_names.hpp"
#include "apps/tandem/text.hpp"

#include <stdexcept>

namespace tandem::command {
namespace {

// NAME.so is loaded by NAMEInit().
std::string the_module(const RtmBuildOptions& options) {
    if (!options.name.empty()) return options.name;
    const auto all = module_names(options.folder);
    if (all.size() == 1) return *all.begin();
    if (all.empty())
        throw std::runtime_error("no source in " + options.folder.string() +
                                 " nor in its src/ defines a module function, void NAMEInit(RTC::Manager*); "
                                 "name the module with --name NAME if it is there all the same");
    std::string names;
    for (const auto& each : all) names += (names.empty() ? "" : ", ") + each;
    throw std::runtime_error(options.folder.string() + " has the modules " + names +
                             "; name the one that is to be loaded with --name NAME");
}

} // namespace

int rtm_build(const RtmBuildOptions& options) {
    require_folder(options.folder);
    const std::string name = the_module(options);
    require_identifier(name);
    print_text(build_plugin("rtm", name, options, options.folder).string() + "\n");
    return 0;
}

} // namespace tandem::command
