// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/shm/segment_format.hpp"

#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "shm/os/clock.hpp"
#include "shm/os/error.hpp"

#include <fmt/format.h>

namespace tandem::command {

// Every switch returns a default for invalid numbers from shared memory.
const char* to_string(shm::Readability readability) {
    switch (readability) {
    case shm::Readability::readable:
        return "readable";
    case shm::Readability::foreign:
        return "foreign";
    case shm::Readability::other_layout:
        return "other layout";
    case shm::Readability::damaged:
        break;
    }
    return "damaged";
}

const char* to_string(shm::PeerState state) {
    switch (state) {
    case shm::PeerState::absent:
        return "absent";
    case shm::PeerState::alive:
        return "alive";
    case shm::PeerState::stopped:
        return "stopped";
    case shm::PeerState::dead:
        break;
    }
    return "dead";
}

std::string format_side(const shm::ObservedSegment& segment, shm::Side which) {
    const shm::ObservedSide& side = segment.side(which);
    // The sides of a foreign segment are unknown. For an unreadable segment, only the lock holders are known.
    if (segment.readability == shm::Readability::foreign) return "-";
    if (segment.readability != shm::Readability::readable) return side.held ? "held" : "-";
    if (side.state == shm::PeerState::absent) return "absent";
    return fmt::format("{}, {}", to_string(side.state), format_pid(side.pid, side.pid_elsewhere));
}

namespace {

/// Returns the age of a time stamp in ns; null if it is 0 or in the future, as in a damaged segment.
nlohmann::json age_json(std::uint64_t since_ns) {
    const std::uint64_t now = shm::now_ns();
    if (since_ns == 0 || since_ns > now) return nullptr;
    return now - since_ns;
}

// Omits keys that are meaningless for a side that has not joined.
nlohmann::json side_json(const shm::ObservedSegment& segment, shm::Side which) {
    const shm::ObservedSide& side = segment.side(which);
    nlohmann::json json{{"held", side.held}};
    if (segment.readability != shm::Readability::readable) return json;
    json["state"] = to_string(side.state);
    json["arena_bytes"] = segment.arena_bytes[shm::index_of(which)];
    if (side.state == shm::PeerState::absent) return json;
    json["pid"] = side.pid != 0 ? nlohmann::json(side.pid) : nlohmann::json();
    if (side.pid_elsewhere != 0) json["pid_in_other_namespace"] = side.pid_elsewhere;
    json["joined_ns_ago"] = age_json(side.joined_ns);
    json["published"] = side.published;
    return json;
}

} // namespace

nlohmann::json to_json(const shm::ObservedSegment& segment) {
    nlohmann::json json{{"link", segment.link},
                        {"generation", segment.generation},
                        {"path", segment.path},
                        {"bytes", segment.file_bytes},
                        {"memory_bytes", segment.memory_bytes},
                        {"owner", user_name(segment.owner)},
                        {"mode", fmt::format("{:04o}", segment.mode)},
                        {"state", to_string(segment.readability)}};
    if (!segment.reason.empty()) json["reason"] = segment.reason;
    if (segment.readability == shm::Readability::foreign)
        return json; // never opened, so nothing more is known
    json["joining_or_leaving"] = segment.changing_hands;
    json["sides"] = {{"first", side_json(segment, shm::Side::first)},
                     {"second", side_json(segment, shm::Side::second)}};
    if (segment.readability != shm::Readability::readable) return json;
    json["layout_version"] = segment.layout_version;
    json["contract"] = fmt::format("{:#x}", segment.contract); // JSON numbers are exact only up to 2^53
    json["created_ns_ago"] = age_json(segment.created_ns);
    json["superseded_by"] =
        segment.superseded_by != 0 ? nlohmann::json(segment.superseded_by) : nlohmann::json();
    return json;
}

std::string format_left_out(std::size_t files) {
    return files == 0 ? "" : fmt::format("{} more files of other users are not listed\n", files);
}

// The message contains the command that lists existing links, because names are easily misspelt.
shm::Observation observe_or_throw(const std::string& link, std::uint64_t generation) {
    if (auto observation = shm::observe(link, generation)) return std::move(*observation);
    throw shm::Error(generation == 0
                         ? "link '" + link +
                               "': no segment in /dev/shm; 'tandem shm list' shows existing segments"
                         : shm::segment_path(link, generation) +
                               ": no such segment; 'tandem shm list' shows existing segments");
}

// Writes to standard error, so that the JSON on standard output stays valid.
int report_if_unreadable(const shm::ObservedSegment& segment) {
    if (segment.readability == shm::Readability::readable) return 0;
    const char* remedy = segment.readability == shm::Readability::foreign ? "run this command as that user"
                         : segment.readability == shm::Readability::other_layout
                             ? "use the tandem program of the build that created it"
                             : "stop the process that holds it, then run 'tandem shm clean'";
    // Not an exception, because the readable data is already printed.
    print_note("tandem: {}: {} ({}); expected a readable segment; {}\n", segment.path,
               to_string(segment.readability), segment.reason, remedy);
    return 1;
}

} // namespace tandem::command
