// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/shm/shm_commands.hpp"
#include "apps/tandem/shm/shm_words.hpp"
#include "apps/tandem/text.hpp"

#include <fmt/format.h>

namespace tandem::command {
namespace {

using shm::Side;

std::string segment_text(const shm::ObservedSegment& segment) {
    std::string text = fmt::format("{}: {} of memory (file {}), owner {}, mode {:04o}", segment.path,
                                   bytes_text(segment.memory_bytes), bytes_text(segment.file_bytes),
                                   user_text(segment.owner), segment.mode);
    if (segment.readability != shm::Readability::readable) return text + "\n";
    text += fmt::format(", layout {}, contract {:#x}, {} old", segment.layout_version, segment.contract,
                        age_text(segment.created_ns));
    if (segment.superseded_by != 0)
        text += fmt::format(", superseded by generation {}", segment.superseded_by);
    if (segment.changing_hands) text += ", somebody is joining or leaving";
    return text + "\n";
}

std::string sides_text(const shm::ObservedSegment& segment) {
    Table table({"side", "state", ">joined", ">heartbeat", ">arena", "objects"});
    for (const Side which : {Side::first, Side::second}) {
        const shm::ObservedSide& side = segment.side(which);
        const bool joined = side.state != shm::PeerState::absent;
        table.add({name_of(which), side_text(segment, which), joined ? age_text(side.joined_ns) : "-",
                   joined ? age_text(side.heartbeat_ns) : "-",
                   bytes_text(segment.arena_bytes[index_of(which)]),
                   side.published ? "published" : "not published"});
    }
    return table.text();
}

std::string description(const shm::ObservedRing& ring) {
    if (!ring.damage.empty()) return "damaged: " + ring.damage;
    std::string text = fmt::format("{} writes, {} in records of up to {}", name_of(ring.writer),
                                   bytes_text(ring.capacity), bytes_text(ring.max_record));
    if (ring.chunks != 0) text += fmt::format(", {} chunks of {}", ring.chunks, bytes_text(ring.chunk_bytes));
    return text;
}

std::string description(const shm::ObservedCallQueue& queue) {
    if (!queue.damage.empty()) return "damaged: " + queue.damage;
    return fmt::format("{} calls, {} slots of {}{}", name_of(queue.callers), queue.slots,
                       bytes_text(queue.max_bytes), queue.closed ? ", closed" : "");
}

std::string objects_text(const shm::Observation& seen) {
    Table table({"object", "kind", "in", "of"});
    for (const auto& ring : seen.rings)
        table.add({printable(ring.name), "ring", name_of(ring.owner), description(ring)});
    for (const auto& queue : seen.call_queues)
        table.add({printable(queue.name), "call queue", name_of(queue.owner), description(queue)});
    for (const auto& blob : seen.blobs)
        table.add({printable(blob.name), "blob", name_of(blob.owner), bytes_text(blob.bytes)});
    std::string text = table.empty() ? "no objects\n" : table.text();
    for (const auto& damage : seen.damage) text += "damaged: " + damage + "\n";
    return text;
}

nlohmann::json common_json(const shm::ObservedObject& object, const char* kind) {
    nlohmann::json json{
        {"name", object.name}, {"kind", kind}, {"owner", name_of(object.owner)}, {"bytes", object.bytes}};
    if (!object.damage.empty()) json["damage"] = object.damage;
    return json;
}

nlohmann::json objects_json(const shm::Observation& seen) {
    auto list = nlohmann::json::array();
    for (const auto& ring : seen.rings) {
        auto json = common_json(ring, "ring");
        if (ring.damage.empty())
            json.update({{"writer", name_of(ring.writer)},
                         {"capacity", ring.capacity},
                         {"max_record", ring.max_record},
                         {"chunks", ring.chunks},
                         {"chunk_bytes", ring.chunk_bytes}});
        list.push_back(json);
    }
    for (const auto& queue : seen.call_queues) {
        auto json = common_json(queue, "call queue");
        if (queue.damage.empty())
            json.update({{"callers", name_of(queue.callers)},
                         {"slots", queue.slots},
                         {"max_bytes", queue.max_bytes},
                         {"closed", queue.closed}});
        list.push_back(json);
    }
    for (const auto& blob : seen.blobs) list.push_back(common_json(blob, "blob"));
    return list;
}

} // namespace

int shm_info(const std::string& link, std::uint64_t generation, bool json) {
    const auto seen = observe_or_throw(link, generation);
    if (json) {
        auto value = to_json(seen.segment);
        value["objects"] = objects_json(seen);
        value["damage"] = seen.damage;
        print_json(value);
    } else {
        std::string text = segment_text(seen.segment);
        if (seen.segment.readability == shm::Readability::readable)
            text += "\n" + sides_text(seen.segment) + "\n" + objects_text(seen);
        print_text(text);
    }
    return report_readability(seen.segment);
}

} // namespace tandem::command
