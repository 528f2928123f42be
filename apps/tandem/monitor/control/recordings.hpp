// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tandem::monitor {

/// Returns the name of a recording that begins now: `tandem-20260102-030405.mcap`.
std::string new_recording_name();

/// Returns the newest 100 recordings in a folder, newest first: {"file", "bytes", "time_ms"}.
nlohmann::json list_recordings(const std::filesystem::path& folder);

/// Returns the path of a recording in the folder; nullopt if the name, which a client has sent, is not that of a recording,
/// or if there is no such regular file.
std::optional<std::filesystem::path> find_recording(const std::filesystem::path& folder,
                                                    std::string_view name);

} // namespace tandem::monitor
