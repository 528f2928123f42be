// SPDX-License-Identifier: Apache-2.0
#include "shm/inspect/observer.hpp"
#include "shm/inspect/quiet_file.hpp"
#include "shm/os/shared_copy.hpp"

#include <bit>

namespace tandem::shm {
namespace {

using layout::CallQueueHeader;
using layout::CallSlot;
using layout::DirectoryEntry;
using layout::RingHeader;
using layout::SideHeader;

constexpr auto cut_off = "the file ends within it";

/// Reads part of a struct into its place in the copy.
template <std::size_t Bytes>
bool read_part(const QuietFile& file, std::uint64_t place, Copied<Bytes>& copy, std::size_t from,
               std::size_t to) {
    return file.read(place + from, {copy.bytes + from, to - from});
}

bool copy_histogram(const QuietFile& file, std::uint64_t place, HistogramCounts& counts) {
    Copied<sizeof(layout::Histogram)> copy;
    if (!file.read(place, copy.bytes)) return false;
    for (std::size_t i = 0; i < counts.counts.size(); ++i)
        counts.counts[i] = copy.get<std::uint64_t>(offsetof(layout::Histogram, counts) + 8 * i);
    return true;
}

/// What a ring of these sizes takes in the arena; 0 for sizes that none has.
std::uint64_t ring_bytes(const ObservedRing& ring) {
    constexpr std::uint64_t largest = std::uint64_t{1} << 36, most_chunks = 64;
    if (ring.capacity > largest || ring.chunk_bytes > largest || ring.chunks > most_chunks) return 0;
    const std::uint64_t records = sizeof(RingHeader) + ring.capacity;
    if (ring.chunks == 0) return records;
    return records + ring.chunks * (sizeof(layout::ChunkWords) + ring.chunk_bytes) + layout::page;
}

ObservedRing view_ring(const QuietFile& file, ObservedObject object, std::uint64_t place) {
    ObservedRing ring{std::move(object)};
    Copied<sizeof(RingHeader)> copy;
    // The reader's counters first: what was received then had been sent before, so never more is received
    // than sent.
    const bool complete =
        ring.bytes >= sizeof(RingHeader) && read_part(file, place, copy, 0, offsetof(RingHeader, head)) &&
        read_part(file, place, copy, offsetof(RingHeader, received), offsetof(RingHeader, age)) &&
        read_part(file, place, copy, offsetof(RingHeader, sent), offsetof(RingHeader, received)) &&
        copy_histogram(file, place + offsetof(RingHeader, age), ring.age);
    if (!complete) {
        ring.damage = cut_off;
        return ring;
    }
    const auto word = [&](std::size_t offset) { return copy.get<std::uint64_t>(offset); };
    const auto policy = copy.get<std::uint32_t>(offsetof(RingHeader, policy));
    const auto writer = copy.get<std::uint32_t>(offsetof(RingHeader, writer));
    ring.policy = static_cast<RingPolicy>(policy);
    ring.writer = static_cast<Side>(writer);
    ring.capacity = word(offsetof(RingHeader, capacity));
    ring.max_record = word(offsetof(RingHeader, max_record));
    ring.wait_ns = word(offsetof(RingHeader, wait_ns));
    ring.chunk_bytes = word(offsetof(RingHeader, chunk_bytes));
    ring.chunks = copy.get<std::uint32_t>(offsetof(RingHeader, chunks));
    ring.counters.sent = word(offsetof(RingHeader, sent));
    ring.counters.refused = word(offsetof(RingHeader, refused));
    ring.counters.overwritten = word(offsetof(RingHeader, overwritten));
    ring.counters.bytes_sent = word(offsetof(RingHeader, bytes_sent));
    ring.counters.received = word(offsetof(RingHeader, received));
    ring.counters.skipped = word(offsetof(RingHeader, skipped));
    ring.counters.bytes_received = word(offsetof(RingHeader, bytes_received));
    if (ring.bytes != ring_bytes(ring) || !std::has_single_bit(ring.capacity) ||
        ring.max_record > ring.capacity / 2 || policy > 3 || writer > 1)
        ring.damage = "its header is not that of a ring of " + std::to_string(ring.bytes) + " bytes";
    return ring;
}

bool count_slots(const QuietFile& file, std::uint64_t slots_begin, ObservedCallQueue& queue) {
    using layout::CallReply;
    using layout::CallRequest;
    for (std::uint32_t i = 0; i < queue.slots; ++i) {
        const std::uint64_t place = slots_begin + i * sizeof(CallSlot);
        Copied<sizeof(CallReply)> reply;
        Copied<sizeof(CallRequest)> request;
        // The reply first: what was answered then had been submitted before.
        if (!file.read(place + offsetof(CallSlot, reply), reply.bytes) ||
            !file.read(place + offsetof(CallSlot, request), request.bytes))
            return false;
        count_slot(queue.counters, reply.get<std::uint64_t>(offsetof(CallReply, answered)),
                   reply.get<std::uint64_t>(offsetof(CallReply, word)),
                   request.get<std::uint64_t>(offsetof(CallRequest, word)),
                   request.get<std::uint64_t>(offsetof(CallRequest, calls)));
    }
    return true;
}

bool copy_times(const QuietFile& file, std::uint64_t place, ObservedCallQueue& queue) {
    return copy_histogram(file, place + offsetof(layout::CallTimes, round_trip), queue.round_trip) &&
           copy_histogram(file, place + offsetof(layout::CallTimes, service), queue.service);
}

ObservedCallQueue view_call_queue(const QuietFile& file, ObservedObject object, std::uint64_t place) {
    ObservedCallQueue queue{std::move(object)};
    Copied<sizeof(CallQueueHeader)> copy;
    if (queue.bytes < sizeof(CallQueueHeader) || !file.read(place, copy.bytes)) {
        queue.damage = cut_off;
        return queue;
    }
    const auto word = [&](std::size_t offset) { return copy.get<std::uint64_t>(offset); };
    const auto half_word = [&](std::size_t offset) { return copy.get<std::uint32_t>(offset); };
    queue.slots = half_word(offsetof(CallQueueHeader, slot_count));
    queue.callers = static_cast<Side>(half_word(offsetof(CallQueueHeader, callers)));
    queue.max_bytes = word(offsetof(CallQueueHeader, max_bytes));
    queue.closed = half_word(offsetof(CallQueueHeader, closed)) != 0;
    const std::uint64_t bytes = call_queue_size({queue.callers, queue.slots, queue.max_bytes});
    if (bytes == 0 || queue.bytes != bytes) {
        queue.damage = "its header is not that of a call queue of " + std::to_string(queue.bytes) + " bytes";
        return queue;
    }
    queue.counters.overloads = word(offsetof(CallQueueHeader, overloads));
    queue.counters.timeouts = word(offsetof(CallQueueHeader, timeouts));
    queue.counters.cancels = word(offsetof(CallQueueHeader, cancels));
    queue.counters.expired = word(offsetof(CallQueueHeader, expired));
    queue.counters.worker_wakes = word(offsetof(CallQueueHeader, worker_wakes));
    queue.counters.caller_wakes = word(offsetof(CallQueueHeader, caller_wakes));
    const std::uint64_t times = place + sizeof(CallQueueHeader);
    if (!count_slots(file, times + sizeof(layout::CallTimes), queue) || !copy_times(file, times, queue))
        queue.damage = cut_off;
    return queue;
}

void view_entry(const QuietFile& file, Observation& into, Side half, std::uint32_t index) {
    const ObservedSegment& segment = into.segment;
    const std::string where =
        std::string("directory of side ") + name_of(half) + ", entry " + std::to_string(index);
    const std::uint64_t place = sizeof(layout::SegmentHeader) + index_of(half) * sizeof(SideHeader) +
                                offsetof(SideHeader, directory) + index * sizeof(DirectoryEntry);
    Copied<sizeof(DirectoryEntry)> copy;
    if (!file.read(place, copy.bytes)) {
        into.damage.push_back(where + ": the file ends before it");
        return;
    }
    const auto* name = reinterpret_cast<const char*>(copy.bytes);
    const auto kind = copy.get<std::uint32_t>(offsetof(DirectoryEntry, kind));
    const auto offset = copy.get<std::uint64_t>(offsetof(DirectoryEntry, offset));
    const auto bytes = copy.get<std::uint64_t>(offsetof(DirectoryEntry, bytes));
    const std::uint64_t arena = segment.arena_bytes[index_of(half)];
    if (name[layout::name_bytes - 1] != '\0' || kind < 1 || kind > 3 || offset % layout::line_pair != 0 ||
        offset > arena || bytes > arena - offset) {
        into.damage.push_back(where + ": names no object within the arena");
        return;
    }
    ObservedObject object{half, name, bytes, {}};
    const std::uint64_t at = segment.arena_offset[index_of(half)] + offset;
    switch (static_cast<layout::ObjectKind>(kind)) {
    case layout::ObjectKind::ring:
        into.rings.push_back(view_ring(file, std::move(object), at));
        break;
    case layout::ObjectKind::call_queue:
        into.call_queues.push_back(view_call_queue(file, std::move(object), at));
        break;
    case layout::ObjectKind::blob:
        into.blobs.push_back(std::move(object));
        break;
    }
}

} // namespace

void observe_objects(const QuietFile& file, Observation& into) {
    for (const Side half : {Side::first, Side::second}) {
        Copied<4> count;
        const std::uint64_t place = sizeof(layout::SegmentHeader) + index_of(half) * sizeof(SideHeader) +
                                    offsetof(SideHeader, published);
        if (!file.read(place, count.bytes)) {
            into.damage.push_back(std::string("side ") + name_of(half) +
                                  ": the file ends before its directory");
            continue;
        }
        const auto published = count.get<std::uint32_t>(0);
        if (published > 1 + layout::max_objects) {
            into.damage.push_back(std::string("directory of side ") + name_of(half) + ": claims " +
                                  std::to_string(published - 1) + " entries, " +
                                  std::to_string(layout::max_objects) + " are possible");
            continue;
        }
        for (std::uint32_t i = 0; i + 1 < published; ++i) view_entry(file, into, half, i);
    }
}

} // namespace tandem::shm
