// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/shm/shm_commands.hpp"
#include "apps/tandem/shm/shm_words.hpp"
#include "apps/tandem/text.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <unistd.h>

namespace tandem::command {
namespace {

using shm::Side;

std::string sides_text(const shm::ObservedSegment& segment) {
    return fmt::format("first {}; second {}", side_text(segment, Side::first),
                       side_text(segment, Side::second));
}

/// Empty: it is gone.
std::string why_left(const shm::ObservedSegment& segment) {
    if (segment.owner != geteuid()) return "of user " + user_text(segment.owner);
    const shm::Probe now = shm::probe_segment(segment.path);
    if (!now.exists) return "";
    if (now.held[0] || now.held[1]) return "in use: " + sides_text(segment);
    if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(segment.path)))
        return segment.reason;
    return "somebody joins or leaves it just now";
}

} // namespace

int shm_clean(const std::string& link, bool json) {
    if (!link.empty()) shm::check_link_name(link);
    auto removed = nlohmann::json::array(), left = nlohmann::json::array();
    std::string text;
    for (const auto& segment : shm::observe_segments()) {
        if (!link.empty() && segment.link != link) continue;
        const bool mine = segment.owner == geteuid();
        if (mine && shm::probe_segment(segment.path).dead() && shm::remove_if_dead(segment.path)) {
            removed.push_back({{"path", segment.path}, {"bytes", segment.file_bytes}});
            text += fmt::format("removed  {} ({}; {})\n", segment.path, bytes_text(segment.file_bytes),
                                segment.reason.empty() ? sides_text(segment) : segment.reason);
        } else if (const std::string why = why_left(segment); !why.empty()) {
            left.push_back({{"path", segment.path}, {"reason", why}});
            text += fmt::format("left     {} ({})\n", segment.path, why);
        }
    }
    if (json)
        print_json({{"removed", removed}, {"left", left}});
    else
        print_text(text.empty() ? "nothing to remove\n" : text);
    return 0;
}

} // namespace tandem::command
