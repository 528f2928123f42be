// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/component_folder.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/rtm/commands.hpp"
#include "apps/tandem/rtm/component_template.hpp"

#include <fmt/format.h>

namespace tandem::command {

// The output contains the next two commands to copy.
int rtm_new(const std::string& name, const std::filesystem::path& parent) {
    require_component_name(name);
    const auto folder = parent / name;
    create_component_folder(folder, rt_component_template(name));
    const std::string shown = folder.lexically_normal().string();
    print_text(fmt::format("{0}: component {1} and an rtc.conf that runs it. Next:\n"
                           "  tandem rtm build {0}\n"
                           "  rtm_host -f {0}/rtc.conf\n",
                           shown, name));
    return 0;
}

} // namespace tandem::command
