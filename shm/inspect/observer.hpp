// SPDX-License-Identifier: Apache-2.0
// Observes segments from outside, while their sides run. Nothing is written, woken or locked. Whatever the
// bytes are, the result says what could be read and gives a reason for what could not.
#pragma once
#include "shm/call/call_queue.hpp"
#include "shm/inspect/histogram_counts.hpp"
#include "shm/ring/ring.hpp"
#include "shm/segment/segment_file.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace tandem::shm {

/// readable: the header is valid. foreign: another user's, not opened. other_layout: of another build of
/// Tandem.
enum class Readability { readable, foreign, other_layout, damaged };

/// One side of a segment. Of a segment that is not readable only `held` is known.
struct ObservedSide {
    PeerState state = PeerState::absent;
    bool held = false;           ///< a living process holds this side's lock
    std::uint32_t pid = 0;       ///< as the side wrote it, in its own pid namespace
    std::uint64_t joined_ns = 0; ///< CLOCK_MONOTONIC, see now_ns()
    bool published = false;
};

/// A segment as its file and its header describe it.
struct ObservedSegment {
    std::string link, path;
    std::uint64_t generation = 0;
    Readability readability = Readability::damaged;
    std::string reason; ///< why it is not readable

    std::uint64_t file_bytes = 0;   ///< size of the file
    std::uint64_t memory_bytes = 0; ///< memory that it takes: less than its size if it is sparse
    uid_t owner = 0;
    mode_t mode = 0;
    bool changing_hands = false; ///< a process joins, leaves or removes it at this moment

    std::uint32_t layout_version = 0; // of the header, if readable
    std::uint64_t contract = 0, created_ns = 0, superseded_by = 0;
    std::uint64_t arena_offset[2] = {}, arena_bytes[2] = {};
    ObservedSide sides[2];

    const ObservedSide& side(Side which) const { return sides[index_of(which)]; }
};

/// What rings, call queues and blobs have in common.
struct ObservedObject {
    Side owner;       ///< in whose arena it lies
    std::string name; ///< as it was written: may hold any byte but zero
    std::uint64_t bytes;
    std::uint64_t file_offset; ///< where it begins in the segment's file
    std::string damage;        ///< empty: valid; otherwise the fields of the derived struct mean nothing
};

/// A blob with a copy of its bytes, of the first MiB of a larger one.
struct ObservedBlob : ObservedObject {
    std::vector<std::byte> content;
};

/// See RingOptions for the sizes and RingCounters for the counters.
struct ObservedRing : ObservedObject {
    Side writer{};
    std::uint64_t capacity = 0, max_record = 0;
    std::uint64_t chunk_bytes = 0; ///< of each chunk for payloads longer than max_record
    std::uint32_t chunks = 0;
    RingCounters counters{};
    HistogramCounts age{}; ///< from published to read, a sample of the records
};

/// A slot with a call that is not answered.
struct ObservedCall {
    std::uint32_t slot = 0;
    CallStage stage{};
    std::uint64_t submitted_ns = 0; ///< CLOCK_MONOTONIC, see now_ns()
    std::optional<double> progress; ///< 0 to 1, if the worker has said how far it is
};

/// See CallQueueOptions for the sizes and CallCounters for the counters.
struct ObservedCallQueue : ObservedObject {
    Side callers{};
    std::uint32_t slots = 0;
    std::uint64_t max_bytes = 0;
    bool closed = false;
    CallCounters counters{};
    std::vector<ObservedCall> open_calls{};
    HistogramCounts round_trip{}, service{}; ///< a sample of the calls, see layout::CallTimes
};

/// A segment and all of its objects, as they were while it was read: not a snapshot of one moment.
struct Observation {
    ObservedSegment segment;
    std::vector<ObservedRing> rings;
    std::vector<ObservedCallQueue> call_queues;
    std::vector<ObservedBlob> blobs;
    std::vector<std::string> damage; ///< one line for each directory entry that cannot be read
};

/// [any-process] All segments of the machine, by link, newest first. Throws Error if /dev/shm cannot be
/// listed.
std::vector<ObservedSegment> observe_segments();

/// [any-process] One generation of a link (0: the newest) and the objects in it; empty if there is none.
/// Throws Error for an impossible link name.
std::optional<Observation> observe(const std::string& link, std::uint64_t generation = 0);

class ReadOnlySnapshot;
/// Used by observe(): adds the objects of a readable segment.
void observe_objects(const ReadOnlySnapshot& file, Observation& into);

} // namespace tandem::shm
