// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/shm/segment_format.hpp"
#include "apps/tandem/shm/shm_commands.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <unistd.h>

namespace tandem::command {
namespace {

using shm::Side;

// The previous holders show whose data is removed.
std::string format_sides(const shm::ObservedSegment& segment) {
    return fmt::format("first {}; second {}", format_side(segment, Side::first),
                       format_side(segment, Side::second));
}

/// Returns why a segment was not removed; empty if it is gone. Probes again, because the observation may be outdated.
std::string reason_kept(const shm::ObservedSegment& segment) {
    if (segment.owner != geteuid()) return "of user " + user_name(segment.owner);
    const shm::Probe probe = shm::probe_segment(segment.path);
    if (!probe.exists) return "";
    if (probe.held[0] || probe.held[1]) return "in use: " + format_sides(segment);
    // Tandem creates only regular files. A folder or link with that name is left alone.
    if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(segment.path)))
        return segment.reason;
    return "a process is joining or leaving it; try again";
}

} // namespace

int shm_clean(const std::string& link, bool json) {
    if (!link.empty()) shm::check_link_name(link);
    auto removed = nlohmann::json::array(), kept = nlohmann::json::array();
    std::string text;
    std::size_t left_out = 0;
    for (const auto& segment : shm::observe_segments(&left_out)) {
        if (!link.empty() && segment.link != link) continue;
        // Root must skip other users' segments; other users cannot remove them because of the sticky bit of /dev/shm.
        const bool owned = segment.owner == geteuid();
        // remove_if_dead() checks again under the segment's lock, so a process that joins in between keeps it.
        if (owned && shm::probe_segment(segment.path).dead() && shm::remove_if_dead(segment.path)) {
            removed.push_back({{"path", segment.path}, {"bytes", segment.file_bytes}});
            text += fmt::format("removed  {} ({}; {})\n", segment.path, format_bytes(segment.file_bytes),
                                segment.reason.empty() ? format_sides(segment) : segment.reason);
            // "": it disappeared after the observation, perhaps removed by another process.
        } else if (const std::string why = reason_kept(segment); !why.empty()) {
            kept.push_back({{"path", segment.path}, {"reason", why}});
            text += fmt::format("kept     {} ({})\n", segment.path, why);
        }
    }
    if (json)
        print_json({{"removed", removed}, {"kept", kept}, {"left_out_of_other_users", left_out}});
    else
        print_text((text.empty() ? "nothing to remove\n" : text) + format_left_out(left_out));
    return 0;
}

} // namespace tandem::command
