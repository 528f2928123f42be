// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/build/folder/source_text.hpp"
#include "apps/tandem/link/component_pair.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/table.hpp"
#include "apps/tandem/system/commands.hpp"

#include <algorithm>
#include <stdexcept>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t max_folders = 1000;

bool is_system(const fs::path& folder) {
    return is_file(folder / "rtm/rtc.conf") || !list_entries(folder / "opros", ".xml").empty();
}

/// Returns the model of the built component in a folder; empty if there is none.
std::string model_of(const fs::path& folder) {
    const auto files = find_component_files(folder);
    return !files.modules.empty() ? "RTM" : files.opros ? "OPRoS" : "";
}

std::vector<fs::path> folders_in(const fs::path& folder) {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder))
        if (const auto name = entry.path().filename().string(); name.front() != '.' && entry.is_directory())
            found.push_back(entry.path());
    if (found.size() > max_folders)
        throw std::runtime_error(folder.string() + " contains more than 1000 folders: name the folder of the "
                                                   "systems and components only");
    std::sort(found.begin(), found.end());
    return found;
}

} // namespace

int system_list(const fs::path& folder, bool as_json) {
    if (!fs::is_directory(folder)) throw std::runtime_error(folder.string() + " is not a folder");
    json systems = json::array(), components = json::array();
    Table table({"name", "what"});
    for (const auto& each : folders_in(folder)) {
        const std::string name = each.filename().string();
        if (is_system(each)) {
            systems.push_back(name);
            table.add_row({name, "system"});
        } else if (const auto model = model_of(each); !model.empty()) {
            components.push_back({{"name", name}, {"model", model}});
            table.add_row({name, model + " component"});
        }
    }
    if (as_json)
        print_json({{"systems", systems}, {"components", components}});
    else
        print_text(table.empty() ? "no system and no built component\n" : table.text());
    return 0;
}

} // namespace tandem::command
