// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/new_folder.hpp"
#include "apps/tandem/rtm/commands.hpp"
#include "apps/tandem/rtm/skeleton.hpp"
#include "apps/tandem/text.hpp"

#include <fmt/format.h>

namespace tandem::command {

int rtm_new(const std::string& name, const std::filesystem::path& parent) {
    require_identifier(name);
    const auto folder = parent / name;
    write_new_folder(folder, rtc_skeleton(name));
    const std::string shown = folder.lexically_normal().string();
    print_text(fmt::format("{0}: component {1} and an rtc.conf that runs it. Next:\n"
                           "  tandem rtm build {0}\n"
                           "  rtm_host -f {0}/rtc.conf\n",
                           shown, name));
    return 0;
}

} // namespace tandem::command
