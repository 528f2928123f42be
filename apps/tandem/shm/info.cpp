// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/output/format.hpp"
#include "apps/tandem/output/print.hpp"
#include "apps/tandem/output/table.hpp"
#include "apps/tandem/shm/segment_format.hpp"
#include "apps/tandem/shm/shm_commands.hpp"

#include <fmt/format.h>

namespace tandem::command {
namespace {

using shm::Side;

// For an unreadable segment, shows only the file system's data.
std::string format_segment(const shm::ObservedSegment& segment) {
    std::string text = fmt::format("{}: {} of memory (file {}), owner {}, mode {:04o}", segment.path,
                                   format_bytes(segment.memory_bytes), format_bytes(segment.file_bytes),
                                   user_name(segment.owner), segment.mode);
    if (segment.readability != shm::Readability::readable) return text + "\n";
    text += fmt::format(", layout {}, contract {:#x}, {} old", segment.layout_version, segment.contract,
                        format_age(segment.created_ns));
    if (segment.superseded_by != 0)
        text += fmt::format(", superseded by generation {}", segment.superseded_by);
    if (segment.changing_hands) text += ", a process is joining or leaving";
    return text + "\n";
}

// Shows "-" for the times of a side that has not joined, whose fields are zero or from the last generation.
std::string format_side_table(const shm::ObservedSegment& segment) {
    Table table({"side", "state", ">joined", ">arena", "objects"});
    for (const Side which : {Side::first, Side::second}) {
        const shm::ObservedSide& side = segment.side(which);
        const bool joined = side.state != shm::PeerState::absent;
        table.add_row({name_of(which), format_side(segment, which), joined ? format_age(side.joined_ns) : "-",
                       format_bytes(segment.arena_bytes[index_of(which)]),
                       side.published ? "published" : "not published"});
    }
    return table.text();
}

// For a damaged object, shows only the reason, because its fields are meaningless.
std::string describe(const shm::ObservedRing& ring) {
    if (!ring.damage.empty()) return "damaged: " + ring.damage;
    std::string text = fmt::format("{} writes, {} in records of up to {}", name_of(ring.writer),
                                   format_bytes(ring.capacity), format_bytes(ring.max_record));
    // Payloads longer than max_record are in chunks that are lent to the writer.
    if (ring.chunks != 0)
        text += fmt::format(", {} chunks of {}", ring.chunks, format_bytes(ring.chunk_bytes));
    return text;
}

// A queue is closed, and refuses calls, after its server has left.
std::string describe(const shm::ObservedCallQueue& queue) {
    if (!queue.damage.empty()) return "damaged: " + queue.damage;
    return fmt::format("{} calls, {} slots of {}{}", name_of(queue.callers), queue.slots,
                       format_bytes(queue.max_bytes), queue.closed ? ", closed" : "");
}

// One table for all kinds: a segment has few objects, and the kinds have few common fields.
std::string format_objects(const shm::Observation& observation) {
    Table table({"object", "kind", "owner", "description"});
    for (const auto& ring : observation.rings)
        table.add_row({replace_nonprintable(ring.name), "ring", name_of(ring.owner), describe(ring)});
    for (const auto& queue : observation.call_queues)
        table.add_row(
            {replace_nonprintable(queue.name), "call queue", name_of(queue.owner), describe(queue)});
    for (const auto& blob : observation.blobs)
        table.add_row(
            {replace_nonprintable(blob.name), "blob", name_of(blob.owner), format_bytes(blob.bytes)});
    std::string text = table.empty() ? "no objects\n" : table.text();
    for (const auto& damage : observation.damage) text += "damaged: " + damage + "\n";
    return text;
}

/// Returns the common fields of rings, call queues and blobs.
nlohmann::json common_json(const shm::ObservedObject& object, const char* kind) {
    nlohmann::json json{
        {"name", object.name}, {"kind", kind}, {"owner", name_of(object.owner)}, {"bytes", object.bytes}};
    if (!object.damage.empty()) json["damage"] = object.damage;
    return json;
}

// Numbers are unscaled: bytes and ns. A damaged object has only its name, kind and reason.
nlohmann::json objects_json(const shm::Observation& observation) {
    auto list = nlohmann::json::array();
    for (const auto& ring : observation.rings) {
        auto json = common_json(ring, "ring");
        if (ring.damage.empty())
            json.update({{"writer", name_of(ring.writer)},
                         {"capacity", ring.capacity},
                         {"max_record", ring.max_record},
                         {"chunks", ring.chunks},
                         {"chunk_bytes", ring.chunk_bytes}});
        list.push_back(json);
    }
    for (const auto& queue : observation.call_queues) {
        auto json = common_json(queue, "call queue");
        if (queue.damage.empty())
            json.update({{"callers", name_of(queue.callers)},
                         {"slots", queue.slots},
                         {"max_bytes", queue.max_bytes},
                         {"closed", queue.closed}});
        list.push_back(json);
    }
    for (const auto& blob : observation.blobs) list.push_back(common_json(blob, "blob"));
    return list;
}

} // namespace

// Shows an unreadable segment as far as it is known. The exit code reports the failure.
int shm_info(const std::string& link, std::uint64_t generation, bool json) {
    const auto observation = observe_or_throw(link, generation);
    if (json) {
        // "objects" and "damage" are empty for an unreadable segment.
        auto value = to_json(observation.segment);
        value["objects"] = objects_json(observation);
        value["damage"] = observation.damage;
        print_json(value);
    } else {
        std::string text = format_segment(observation.segment);
        if (observation.segment.readability == shm::Readability::readable)
            text += "\n" + format_side_table(observation.segment) + "\n" + format_objects(observation);
        print_text(text);
    }
    return report_if_unreadable(observation.segment);
}

} // namespace tandem::command
