// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/import/rtm_setup.hpp"

#include "host/text/printable.hpp"

#include <coil/stringutil.h>

#include <algorithm>

namespace tandem::command {

namespace fs = std::filesystem;

std::vector<std::string> split_list(const std::string& text) { return coil::split(text, ",", true); }

bool RtmSetup::creates(const std::string& instance) const {
    return std::any_of(components.begin(), components.end(),
                       [&](const auto& each) { return each.name == instance; });
}

// Counts as the manager's policy process_unique: an instance with an explicit name also uses up a number.
std::string RtmSetup::next_name(const std::string& type) const {
    return type + std::to_string(std::count_if(components.begin(), components.end(),
                                               [&](const auto& each) { return each.type == type; }));
}

const ConfSetting* RtmSetup::find(const std::string& key) const {
    const auto found =
        std::find_if(settings.begin(), settings.end(), [&](const auto& each) { return each.key == key; });
    return found == settings.end() ? nullptr : &*found;
}

fs::path RtmSetup::resolve(const std::string& file) const {
    const fs::path path(file);
    std::error_code ignored; // without permission, the file counts as absent
    for (const auto& place : {installation / path, conf.parent_path() / path})
        if (fs::exists(place, ignored)) {
            const fs::path found = fs::absolute(place).lexically_normal();
            return found.has_filename() ? found : found.parent_path(); // for a path written as DIR/ or .
        }
    return {};
}

std::string RtmSetup::text(const std::string& writer) const {
    std::string text = "# Written by " + writer + " from " +
                       text::printable_line((conf.empty() ? installation : conf).string()) +
                       ". Start rtm_host in this folder, as tandem run does.\n";
    const auto add = [&](const char* key, const std::vector<std::string>& entries) {
        std::string list;
        for (const auto& entry : entries) list += (list.empty() ? "" : ", \\\n    ") + coil::escape(entry);
        if (!list.empty()) text += std::string(key) + ": " + list + "\n";
    };
    std::vector<std::string> folders{"."}, created;
    for (const auto& folder : load_path)
        if (std::find(folders.begin(), folders.end(), folder.string()) == folders.end())
            folders.push_back(folder.string());
    for (const auto& component : components) created.push_back(component.entry);
    add("manager.modules.load_path", folders);
    add("manager.modules.preload", modules);
    add("manager.components.precreate", created);
    add("manager.components.preconnect", connections);
    add("manager.components.preactivation", activations);
    for (const auto& setting : settings) text += setting.key + ": " + coil::escape(setting.value) + "\n";
    return text;
}

} // namespace tandem::command
