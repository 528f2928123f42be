// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/table.hpp"
#include "apps/tandem/shm/segment_format.hpp"
#include "apps/tandem/shm/shm_commands.hpp"

#include <fmt/format.h>

namespace tandem::command {
namespace {

/// Returns why a segment is unreadable, or that a newer generation has replaced it; "" otherwise.
std::string segment_note(const shm::ObservedSegment& segment) {
    if (segment.readability == shm::Readability::foreign) return segment.reason;
    if (segment.readability != shm::Readability::readable)
        return fmt::format("{}: {}", to_string(segment.readability), segment.reason);
    if (segment.superseded_by != 0) return fmt::format("superseded by generation {}", segment.superseded_by);
    return "";
}

} // namespace

int shm_list(bool json) {
    // Observing takes no lock, so segments may come and go meanwhile. Each entry has its own time.
    std::size_t left_out = 0;
    const auto segments = shm::observe_segments(&left_out);
    if (json) {
        auto list = nlohmann::json::array();
        for (const auto& segment : segments) list.push_back(to_json(segment));
        print_json({{"segments", list}, {"left_out_of_other_users", left_out}});
        return 0;
    }
    // Names from shared memory or file names may contain any byte.
    Table table({"link", ">gen", ">memory", "owner", "first", "second", ">age", "note"});
    for (const auto& segment : segments)
        table.add_row(
            {replace_nonprintable(segment.link), std::to_string(segment.generation),
             format_bytes(segment.memory_bytes), user_name(segment.owner),
             format_side(segment, shm::Side::first), format_side(segment, shm::Side::second),
             segment.readability == shm::Readability::readable ? format_age(segment.created_ns) : "-",
             segment_note(segment)});
    print_text((table.empty() ? "no segments in /dev/shm\n" : table.text()) + format_left_out(left_out));
    return 0;
}

} // namespace tandem::command
