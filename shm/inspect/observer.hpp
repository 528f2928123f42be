// SPDX-License-Identifier: Apache-2.0
// Observes segments from outside while their sides run. Nothing is written, woken or locked. For any bytes, the result
// contains what could be read, and gives a reason for what could not.
#pragma once
#include "shm/call/call_queue.hpp"
#include "shm/inspect/histogram_counts.hpp"
#include "shm/ring/ring.hpp"
#include "shm/segment/segment_file.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tandem::shm {

/// readable: the header is valid. foreign: belongs to another user, not opened. other_layout: from another build of Tandem.
enum class Readability { readable, foreign, other_layout, damaged };

/// One side of a segment. If the segment is not readable, only `held` is known.
struct ObservedSide {
    PeerState state = PeerState::absent;
    bool held = false; ///< the side lives, see side_lives()
    std::uint32_t pid =
        0; ///< of its process; of a dead side, the pid that the process had; 0: see pid_elsewhere
    /// As the side wrote it, if the process belongs to another pid namespace: an unrelated process may have this pid here.
    std::uint32_t pid_elsewhere = 0;
    std::uint64_t joined_ns = 0; ///< CLOCK_MONOTONIC, see now_ns()
    bool published = false;
    bool left = false; ///< it has left cleanly; a dead side that has not was killed or has crashed
};

/// A segment as described by its file and its header.
struct ObservedSegment {
    std::string link, path;
    std::uint64_t generation = 0;
    Readability readability = Readability::damaged;
    std::string reason; ///< why it is not readable

    std::uint64_t file_bytes = 0;   ///< size of the file; of a readable segment, without the loans of calls
    std::uint64_t memory_bytes = 0; ///< memory used: less than the size if the file is sparse
    uid_t owner = 0;
    mode_t mode = 0;
    dev_t device = 0; ///< with `inode`: identifies the file, whatever its name refers to later
    ino_t inode = 0;
    bool changing_hands = false; ///< a process is joining, leaving or removing it at this moment

    std::uint32_t layout_version = 0; // of the header, if readable
    std::uint64_t contract = 0, created_ns = 0, superseded_by = 0;
    std::uint64_t arena_offset[2] = {}, arena_bytes[2] = {};
    ObservedSide sides[2];

    const ObservedSide& side(Side which) const { return sides[index_of(which)]; }
};

/// The common part of rings, call queues and blobs.
struct ObservedObject {
    Side owner;       ///< the side whose arena holds it
    std::string name; ///< as it was written: may contain any byte except zero
    std::uint64_t bytes;
    std::uint64_t file_offset; ///< its beginning in the segment's file
    std::string damage;        ///< empty: valid; otherwise the fields of the derived struct are meaningless
};

/// A blob with a copy of its bytes; of a larger blob, the first MiB.
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
    HistogramCounts age{}; ///< from publishing to reading, of sampled records
};

/// A slot with an unanswered call.
struct ObservedCall {
    std::uint32_t slot = 0;
    CallStage stage{};
    std::uint64_t submitted_ns = 0; ///< CLOCK_MONOTONIC, see now_ns()
    std::optional<double> progress; ///< 0 to 1, if the worker has reported any
};

/// See CallQueueOptions for the sizes and CallCounters for the counters.
struct ObservedCallQueue : ObservedObject {
    Side callers{};
    std::uint32_t slots = 0;
    std::uint64_t max_bytes = 0;
    bool closed = false;
    CallCounters counters{};
    std::vector<ObservedCall> open_calls{};
    HistogramCounts round_trip{}, service{}; ///< of sampled calls, see layout::CallTimes
};

/// A segment and all of its objects, as read while both sides run: not a snapshot of one moment.
struct Observation {
    ObservedSegment segment;
    std::vector<ObservedRing> rings;
    std::vector<ObservedCallQueue> call_queues;
    std::vector<ObservedBlob> blobs;
    std::vector<std::string> damage; ///< one line for each directory entry that cannot be read
};

/// Any user may fill /dev/shm with names of segments, so a list contains at most this many files of other users.
constexpr std::size_t max_foreign = 100;

/// [any-process] Returns all segments of the machine, by link, newest first. Sets `left_out` to the number of files of other
/// users beyond max_foreign. Throws Error if /dev/shm cannot be listed.
std::vector<ObservedSegment> observe_segments(std::size_t* left_out = nullptr);

/// [any-process] Returns one generation of a link with its objects; empty if there is none. 0: the newest that this process
/// may use, or the newest of another user if there is no such. Throws Error for an invalid link name.
std::optional<Observation> observe(const std::string& link, std::uint64_t generation = 0);

class ReadOnlySnapshot;
/// Opens the file of a readable segment again. Returns nullptr if its name refers to another file by now.
std::shared_ptr<const ReadOnlySnapshot> open_observed(const ObservedSegment& segment);

/// Returns whether a side of an opened segment has left cleanly. Also works after the file was removed.
bool has_left(const ReadOnlySnapshot& file, Side side);

/// Adds the objects of a readable segment. Used by observe().
void observe_objects(const ReadOnlySnapshot& file, Observation& into);

} // namespace tandem::shm
