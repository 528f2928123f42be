// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/new_folder.hpp"
#include "apps/tandem/opros/commands.hpp"
#include "apps/tandem/opros/skeleton.hpp"
#include "apps/tandem/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace tandem::command {
namespace {

// What the skeleton uses of the API, or defines: a class of the same name would be another one.
constexpr std::array<const char*, 8> of_the_api{"Component",        "Event",        "InputDataPort",
                                                "OutputDataPort",   "getComponent", "getVersion",
                                                "releaseComponent", "ReturnType"};

} // namespace

int opros_new(const std::string& name, const std::filesystem::path& parent) {
    require_identifier(name);
    if (std::find(of_the_api.begin(), of_the_api.end(), name) != of_the_api.end())
        throw std::runtime_error("'" + name +
                                 "' cannot be the name of a component, the OPRoS API has one of it");
    const auto folder = parent / name;
    write_new_folder(folder, component_skeleton(name));
    const std::string shown = folder.lexically_normal().string();
    print_text(fmt::format("{0}: component {1}, its profile, and an application of it. Next:\n"
                           "  tandem opros build {0}\n"
                           "  opros_host {0}/{1}App.xml\n",
                           shown, name));
    return 0;
}

} // namespace tandem::command
