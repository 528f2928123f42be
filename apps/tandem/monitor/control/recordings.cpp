// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/monitor/control/recordings.hpp"

#include <fmt/chrono.h>
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <ctime>
#include <vector>

namespace tandem::monitor {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view pattern = "tandem-00000000-000000.mcap"; ///< 0: any digit
constexpr std::size_t max_listed = 100;

bool is_recording_name(std::string_view name) {
    return std::equal(name.begin(), name.end(), pattern.begin(), pattern.end(), [](char c, char expected) {
        return expected == '0' ? std::isdigit(static_cast<unsigned char>(c)) != 0 : c == expected;
    });
}

} // namespace

std::string new_recording_name() {
    return fmt::format("tandem-{:%Y%m%d-%H%M%S}.mcap", fmt::localtime(std::time(nullptr)));
}

nlohmann::json list_recordings(const fs::path& folder) {
    std::vector<std::string> names; // which sort by their time
    std::error_code unreadable;
    for (const auto& entry : fs::directory_iterator(folder, unreadable))
        if (std::string name = entry.path().filename().string(); is_recording_name(name))
            names.push_back(std::move(name));
    std::sort(names.rbegin(), names.rend());
    nlohmann::json list = nlohmann::json::array();
    for (const std::string& name : names) {
        struct stat file {};
        if (list.size() == max_listed) break;
        if (lstat((folder / name).c_str(), &file) != 0 || !S_ISREG(file.st_mode)) continue;
        list.push_back({{"file", name},
                        {"bytes", file.st_size},
                        {"time_ms", std::uint64_t{1000} * static_cast<std::uint64_t>(file.st_mtime)}});
    }
    return list;
}

std::optional<fs::path> find_recording(const fs::path& folder, std::string_view name) {
    std::error_code missing;
    fs::path path = folder / name;
    return is_recording_name(name) && fs::symlink_status(path, missing).type() == fs::file_type::regular
               ? std::optional(std::move(path))
               : std::nullopt;
}

} // namespace tandem::monitor
