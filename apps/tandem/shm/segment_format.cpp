// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/shm/segment_format.hpp"

#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print_note.hpp"
#include "shm/os/clock.hpp"
#include "shm/os/error.hpp"

#include <fmt/format.h>

namespace tandem::command {

// Every switch ends with a value for numbers that are none of the enumeration's: they come from shared memory.
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

// The pid is that of the process's own pid namespace: in a container it is not the one that the host's ps shows.
std::string format_side(const shm::ObservedSegment& segment, shm::Side which) {
    const shm::ObservedSide& side = segment.side(which);
    // Nothing is known of a foreign segment's sides; of an unreadable one only who holds its locks.
    if (segment.readability == shm::Readability::foreign) return "-";
    if (segment.readability != shm::Readability::readable) return side.held ? "held" : "-";
    if (side.state == shm::PeerState::absent) return "absent";
    return fmt::format("{}, pid {}", to_string(side.state), side.pid);
}

namespace {

/// Age of a time stamp in ns; null if it is 0 or in the future, which a damaged segment may claim.
nlohmann::json age_json(std::uint64_t since_ns) {
    const std::uint64_t now = shm::now_ns();
    if (since_ns == 0 || since_ns > now) return nullptr;
    return now - since_ns;
}

// The keys of a side that has not joined would have no meaning and are left out.
nlohmann::json side_json(const shm::ObservedSegment& segment, shm::Side which) {
    const shm::ObservedSide& side = segment.side(which);
    nlohmann::json json{{"held", side.held}};
    if (segment.readability != shm::Readability::readable) return json;
    json["state"] = to_string(side.state);
    json["arena_bytes"] = segment.arena_bytes[shm::index_of(which)];
    if (side.state == shm::PeerState::absent) return json;
    json["pid"] = side.pid;
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
    if (segment.readability == shm::Readability::foreign) return json; // never opened: nothing more is known
    json["joining_or_leaving"] = segment.changing_hands;
    json["sides"] = {{"first", side_json(segment, shm::Side::first)},
                     {"second", side_json(segment, shm::Side::second)}};
    if (segment.readability != shm::Readability::readable) return json;
    json["layout_version"] = segment.layout_version;
    json["contract"] = fmt::format("{:#x}", segment.contract); // JSON numbers are exact up to 2^53 only
    json["created_ns_ago"] = age_json(segment.created_ns);
    json["superseded_by"] =
        segment.superseded_by != 0 ? nlohmann::json(segment.superseded_by) : nlohmann::json();
    return json;
}

// The message names the command that lists what exists, since a link's name is easily misspelt.
shm::Observation observe_or_throw(const std::string& link, std::uint64_t generation) {
    if (auto observation = shm::observe(link, generation)) return std::move(*observation);
    throw shm::Error(generation == 0
                         ? "link '" + link +
                               "': no segment in /dev/shm; 'tandem shm list' shows existing segments"
                         : shm::segment_path(link, generation) +
                               ": no such segment; 'tandem shm list' shows existing segments");
}

// Standard error, so that the JSON on standard output stays whole.
int report_if_unreadable(const shm::ObservedSegment& segment) {
    if (segment.readability == shm::Readability::readable) return 0;
    const char* remedy = segment.readability == shm::Readability::foreign ? "run this command as that user"
                         : segment.readability == shm::Readability::other_layout
                             ? "use the tandem program of the build that created it"
                             : "stop the process that holds it, then run 'tandem shm clean'";
    // Not an exception: what could be read has been printed already.
    print_note("tandem: {}: {} ({}); expected a readable segment; {}\n", segment.path,
               to_string(segment.readability), segment.reason, remedy);
    return 1;
}

} // namespace tandem::command
