// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/component_folder.hpp"
#include "apps/tandem/opros/commands.hpp"
#include "apps/tandem/opros/component_template.hpp"
#include "apps/tandem/output/print.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace tandem::command {
namespace {

// API names that the template uses, and functions that it defines. A class must not have such a name.
constexpr std::array<const char*, 8> api_names{"Component",        "Event",        "InputDataPort",
                                               "OutputDataPort",   "getComponent", "getVersion",
                                               "releaseComponent", "ReturnType"};

} // namespace

int opros_new(const std::string& name, const std::filesystem::path& parent) {
    require_component_name(name);
    if (std::find(api_names.begin(), api_names.end(), name) != api_names.end())
        throw std::runtime_error("'" + name +
                                 "' is not a valid component name: the OPRoS API has a class with this name");
    const auto folder = parent / name;
    create_component_folder(folder, opros_component_template(name));
    // The output contains the next two commands to copy.
    const std::string shown = folder.lexically_normal().string();
    print_text(fmt::format("{0}: component {1}, its profile, and an application with it. Next:\n"
                           "  tandem opros build {0}\n"
                           "  opros_host {0}/{1}App.xml\n",
                           shown, name));
    return 0;
}

} // namespace tandem::command
