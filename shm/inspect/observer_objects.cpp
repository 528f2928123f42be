// SPDX-License-Identifier: Apache-2.0
#include "shm/inspect/observer.hpp"
#include "shm/inspect/read_only_snapshot.hpp"
#include "shm/os/shared_copy.hpp"

#include <algorithm>

namespace tandem::shm {
namespace {

using layout::CallQueueHeader;
using layout::CallSlot;
using layout::DirectoryEntry;
using layout::RingHeader;
using layout::SideHeader;

constexpr auto truncated_text = "the file ends within it, or has no memory for it";

/// Reads the bytes [from, to) of a struct into the same bytes of its copy.
bool read_part(const ReadOnlySnapshot& file, std::uint64_t base, Snapshot<RingHeader>& copy, std::size_t from,
               std::size_t to) {
    return file.read(base + from, copy.room(from, to));
}

/// Copies the counts of a histogram. Returns false if the file ends within it.
bool copy_histogram(const ReadOnlySnapshot& file, std::uint64_t base, HistogramCounts& counts) {
    Snapshot<layout::Histogram> copy;
    if (!file.read(base, copy)) return false;
    for (std::size_t i = 0; i < counts.counts.size(); ++i)
        counts.counts[i] = copy.get<std::uint64_t>(offsetof(layout::Histogram, counts) + 8 * i);
    return true;
}

/// The memory of a segment's file that no object has claimed yet. The objects of an honest side have memory, and none of it
/// belongs to two of them. So all objects together make an observer allocate no more than the file takes itself, whatever
/// their headers say.
class Unclaimed {
  public:
    explicit Unclaimed(const ReadOnlySnapshot& file) : bytes_(file.memory_bytes()) {}
    bool claim(std::uint64_t bytes) {
        if (bytes > bytes_) return false;
        bytes_ -= bytes;
        return true;
    }

  private:
    std::uint64_t bytes_;
};

/// Reads a ring. `damage` of the result says what is wrong with it.
ObservedRing read_ring(const ReadOnlySnapshot& file, ObservedObject object, Unclaimed& unclaimed) {
    ObservedRing ring{std::move(object)};
    const std::uint64_t base = ring.file_offset;
    Snapshot<RingHeader> copy;
    // Reads the reader's counters first: a received message was sent before, so the copy never has more messages received
    // than sent.
    const bool complete =
        ring.bytes >= sizeof(RingHeader) && unclaimed.claim(sizeof(RingHeader)) &&
        read_part(file, base, copy, 0, offsetof(RingHeader, head)) &&
        read_part(file, base, copy, offsetof(RingHeader, received), offsetof(RingHeader, age)) &&
        read_part(file, base, copy, offsetof(RingHeader, sent), offsetof(RingHeader, received)) &&
        copy_histogram(file, base + offsetof(RingHeader, age), ring.age);
    if (!complete) {
        ring.damage = truncated_text;
        return ring;
    }
    const auto word = [&](std::size_t offset) { return copy.get<std::uint64_t>(offset); };
    const auto writer = copy.get<std::uint32_t>(offsetof(RingHeader, writer));
    ring.writer = static_cast<Side>(writer);
    ring.capacity = word(offsetof(RingHeader, capacity));
    ring.max_record = word(offsetof(RingHeader, max_record));
    ring.chunk_bytes = word(offsetof(RingHeader, chunk_bytes));
    ring.chunks = copy.get<std::uint32_t>(offsetof(RingHeader, chunks));
    ring.counters.sent = word(offsetof(RingHeader, sent));
    ring.counters.refused = word(offsetof(RingHeader, refused));
    ring.counters.overwritten = word(offsetof(RingHeader, overwritten));
    ring.counters.bytes_sent = word(offsetof(RingHeader, bytes_sent));
    ring.counters.received = word(offsetof(RingHeader, received));
    ring.counters.skipped = word(offsetof(RingHeader, skipped));
    ring.counters.bytes_received = word(offsetof(RingHeader, bytes_received));
    ring.counters.converted =
        word(offsetof(RingHeader, converted_by_writer)) + word(offsetof(RingHeader, converted_by_reader));
    ring.counters.undecodable = word(offsetof(RingHeader, undecodable));
    ring.counters.missed_deadlines = word(offsetof(RingHeader, missed_deadlines));
    ring.counters.discarded = word(offsetof(RingHeader, discarded));
    ring.counters.depth = word(offsetof(RingHeader, depth));
    ring.counters.skip_beyond_depth();
    if (ring.bytes != ring_bytes({ring.capacity, ring.max_record, ring.chunk_bytes, ring.chunks, writer}))
        ring.damage = "its header is not that of a ring of " + std::to_string(ring.bytes) + " bytes";
    return ring;
}

/// Returns the call of a slot if it is not answered.
std::optional<ObservedCall> open_call(std::uint32_t slot, const CallSlotWords& words, std::uint64_t progress,
                                      std::uint64_t submitted_ns) {
    const CallStage stage = stage_of(words);
    if (stage == CallStage::none) return std::nullopt;
    ObservedCall call{slot, stage, submitted_ns, std::nullopt};
    if (stage != CallStage::waiting && sequence_of(progress) == sequence_of(words.request))
        call.progress = share_of(progress);
    return call;
}

/// Adds up the counters of all slots, and finds their open calls. Returns false if the file ends within them.
bool count_slots(const ReadOnlySnapshot& file, std::uint64_t slots_begin, ObservedCallQueue& queue) {
    using layout::CallReply;
    using layout::CallRequest;
    using layout::CallWork;
    for (std::uint32_t i = 0; i < queue.slots; ++i) {
        const std::uint64_t base = slots_begin + i * sizeof(CallSlot);
        Snapshot<CallWork> work;
        Snapshot<CallReply> reply;
        Snapshot<CallRequest> request;
        // Reads the request last: an answered call was submitted before.
        if (!file.read(base + offsetof(CallSlot, work), work) ||
            !file.read(base + offsetof(CallSlot, reply), reply) ||
            !file.read(base + offsetof(CallSlot, request), request))
            return false;
        const CallSlotWords words{work.get<std::uint64_t>(offsetof(CallWork, answered)),
                                  reply.get<std::uint64_t>(offsetof(CallReply, word)),
                                  work.get<std::uint64_t>(offsetof(CallWork, claim)),
                                  request.get<std::uint64_t>(offsetof(CallRequest, word)),
                                  request.get<std::uint64_t>(offsetof(CallRequest, calls))};
        count_slot(queue.counters, words);
        if (const auto call = open_call(i, words, work.get<std::uint64_t>(offsetof(CallWork, progress)),
                                        request.get<std::uint64_t>(offsetof(CallRequest, submitted_ns))))
            queue.open_calls.push_back(*call);
    }
    return true;
}

/// Copies both histograms of a call queue. Returns false if the file ends within them.
bool copy_times(const ReadOnlySnapshot& file, std::uint64_t base, ObservedCallQueue& queue) {
    return copy_histogram(file, base + offsetof(layout::CallTimes, round_trip), queue.round_trip) &&
           copy_histogram(file, base + offsetof(layout::CallTimes, service), queue.service);
}

/// Reads a call queue. `damage` of the result says what is wrong with it.
ObservedCallQueue read_call_queue(const ReadOnlySnapshot& file, ObservedObject object, Unclaimed& unclaimed) {
    ObservedCallQueue queue{std::move(object)};
    const std::uint64_t base = queue.file_offset;
    Snapshot<CallQueueHeader> copy;
    if (queue.bytes < sizeof(CallQueueHeader) || !file.read(base, copy)) {
        queue.damage = truncated_text;
        return queue;
    }
    const auto word = [&](std::size_t offset) { return copy.get<std::uint64_t>(offset); };
    const auto word32 = [&](std::size_t offset) { return copy.get<std::uint32_t>(offset); };
    queue.slots = word32(offsetof(CallQueueHeader, slot_count));
    queue.callers = static_cast<Side>(word32(offsetof(CallQueueHeader, callers)));
    queue.max_bytes = word(offsetof(CallQueueHeader, max_bytes));
    queue.closed = word32(offsetof(CallQueueHeader, closed)) != 0;
    // Limits the number of slots, over which count_slots() loops, by the bytes of the object.
    const std::uint64_t bytes = call_queue_size({queue.callers, queue.slots, queue.max_bytes});
    if (bytes == 0 || queue.bytes != bytes || !unclaimed.claim(queue.slots * sizeof(CallSlot))) {
        queue.damage = "its header is not that of a call queue of " + std::to_string(queue.bytes) + " bytes";
        return queue;
    }
    queue.counters.overloads = word(offsetof(CallQueueHeader, overloads));
    queue.counters.timeouts = word(offsetof(CallQueueHeader, timeouts));
    queue.counters.cancels = word(offsetof(CallQueueHeader, cancels));
    queue.counters.expired = word(offsetof(CallQueueHeader, expired));
    queue.counters.worker_wakes = word(offsetof(CallQueueHeader, worker_wakes));
    queue.counters.caller_wakes = word(offsetof(CallQueueHeader, caller_wakes));
    const std::uint64_t times = base + sizeof(CallQueueHeader);
    if (!count_slots(file, times + sizeof(layout::CallTimes), queue) || !copy_times(file, times, queue))
        queue.damage = truncated_text;
    return queue;
}

/// Reads a blob. `damage` of the result says what is wrong with it.
ObservedBlob read_blob(const ReadOnlySnapshot& file, ObservedObject object, Unclaimed& unclaimed) {
    constexpr std::uint64_t max_content = std::uint64_t{1} << 20;
    ObservedBlob blob{std::move(object), {}};
    const std::uint64_t content = std::min(blob.bytes, max_content);
    if (!unclaimed.claim(content)) {
        blob.damage = "the file has no memory for its " + std::to_string(blob.bytes) + " bytes";
        return blob;
    }
    blob.content.resize(content);
    if (!file.read(blob.file_offset, blob.content)) blob.damage = truncated_text;
    return blob;
}

/// Reads one entry of a directory and its object. Does not follow an entry that points outside of the arena.
void read_entry(const ReadOnlySnapshot& file, Observation& into, Side owner, std::uint32_t index,
                Unclaimed& unclaimed) {
    const ObservedSegment& segment = into.segment;
    const std::string where =
        std::string("directory of side ") + name_of(owner) + ", entry " + std::to_string(index);
    const std::uint64_t base = sizeof(layout::SegmentHeader) + index_of(owner) * sizeof(SideHeader) +
                               offsetof(SideHeader, directory) + index * sizeof(DirectoryEntry);
    Snapshot<DirectoryEntry> copy;
    if (!file.read(base, copy)) {
        into.damage.push_back(where + ": the file ends before it");
        return;
    }
    const auto* name = reinterpret_cast<const char*>(copy.bytes().data());
    const auto kind = copy.get<std::uint32_t>(offsetof(DirectoryEntry, kind));
    const auto offset = copy.get<std::uint64_t>(offsetof(DirectoryEntry, offset));
    const auto bytes = copy.get<std::uint64_t>(offsetof(DirectoryEntry, bytes));
    const std::uint64_t arena = segment.arena_bytes[index_of(owner)];
    // Checked before the name is used as a string and the offset as a place in the file.
    if (name[layout::name_bytes - 1] != '\0' || kind < 1 || kind > 3 || offset % layout::line_pair != 0 ||
        offset > arena || bytes > arena - offset) {
        into.damage.push_back(where + ": names no object within the arena");
        return;
    }
    const std::uint64_t at = segment.arena_offset[index_of(owner)] + offset;
    ObservedObject object{owner, name, bytes, at, {}};
    switch (static_cast<layout::ObjectKind>(kind)) {
    case layout::ObjectKind::ring:
        into.rings.push_back(read_ring(file, std::move(object), unclaimed));
        break;
    case layout::ObjectKind::call_queue:
        into.call_queues.push_back(read_call_queue(file, std::move(object), unclaimed));
        break;
    case layout::ObjectKind::blob:
        into.blobs.push_back(read_blob(file, std::move(object), unclaimed));
        break;
    }
}

} // namespace

void observe_objects(const ReadOnlySnapshot& file, Observation& into) {
    std::uint32_t published[2] = {}; // 0 = nothing yet, else 1 + number of entries
    for (const Side owner : {Side::first, Side::second}) {
        const std::uint64_t base = sizeof(layout::SegmentHeader) + index_of(owner) * sizeof(SideHeader) +
                                   offsetof(SideHeader, published);
        std::uint32_t& count = published[index_of(owner)];
        const std::string side = std::string("side ") + name_of(owner);
        if (!file.read(base, std::as_writable_bytes(std::span(&count, 1)))) {
            into.damage.push_back(side + ": the file ends before its directory");
        } else if (count > 1 + layout::max_objects) {
            into.damage.push_back("directory of " + side + ": claims " + std::to_string(count - 1) +
                                  " entries, " + std::to_string(layout::max_objects) + " are possible");
            count = 0;
        }
    }
    Unclaimed unclaimed(file); // after the counts: what is published has its memory
    for (const Side owner : {Side::first, Side::second})
        for (std::uint32_t i = 0; i + 1 < published[index_of(owner)]; ++i)
            read_entry(file, into, owner, i, unclaimed);
}

} // namespace tandem::shm
