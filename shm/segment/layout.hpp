// SPDX-License-Identifier: Apache-2.0
// What the bytes of a segment mean: the ABI between two processes that may have been built apart. Any change of a
// field, its meaning or its place raises layout_version; a process of another version is refused when it joins.
//
// A segment is one *generation* of a link: the file /dev/shm/tandem.<link>.<generation>, joined by two sides.
// Each side owns a SideHeader (its identity, its doorbell, the directory of its objects) and an arena that
// holds the objects themselves. A side takes a generation once; after its death the generation is never
// reopened, and the next one gets a new name. So nothing here is ever reset, and no state has to be repaired.
//
//      0 +---------------------------+
//        | SegmentHeader             |  written before the file has a name; only superseded_by changes later
//  4 KiB +---------------------------+
//        | SideHeader of first       |  identity | doorbell | published | directory[512]
//        +---------------------------+
//        | SideHeader of second      |
//        +---------------------------+  arena_offset[0], page aligned
//        | arena of first            |  objects: rings, call queues, blobs, each 128-aligned
//        +---------------------------+  arena_offset[1]
//        | arena of second           |
//        +---------------------------+  total_bytes: the end of the mapped memory
//        | loans of calls            |  never mapped; the file grows with the first one
//        +---------------------------+
//
// Memory is reserved and touched at creation. In a sparse segment, an object's header when it is added, the records of a
// ring with the first message, a chunk and a call's overflow buffer when they are first used.
//
// Bytes 0 to 2 of the file serve as locks (liveness.hpp); their values are meaningless.
//
// All code that reads a segment assumes that the peer changes any byte at any time: sizes and offsets are copied
// once, checked, and then only the copy is used. For the size of the file see truncation_guard.hpp.
//
// Atomic words are on separate pairs of cache lines, because the hardware fetches lines in pairs.
#pragma once
#include "shm/os/atomics.hpp"
#include "shm/segment/histogram.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace tandem::shm::layout {

using Word32 = std::atomic<std::uint32_t>;
using Word64 = std::atomic<std::uint64_t>;
static_assert(Word32::is_always_lock_free && sizeof(Word32) == 4);
static_assert(Word64::is_always_lock_free && sizeof(Word64) == 8);

// "TANDEM01", read as bytes by a processor with the byte order of the one that has made the file
constexpr std::uint64_t magic = 0x31304d45444e4154;
constexpr std::uint32_t layout_version = 11;
constexpr std::size_t page = 4096; // unit of arenas and chunks, whatever pages the kernel has
constexpr std::size_t line = 64;
constexpr std::size_t line_pair = 128;
constexpr std::size_t max_objects = 512;
constexpr std::size_t name_bytes = 104; // with the terminating zero

struct SegmentHeader {
    std::uint64_t magic;
    std::uint32_t layout_version;
    std::uint32_t header_bytes; // offset of the first SideHeader
    std::uint64_t contract;     // version of the users' own agreement, opaque here
    std::uint64_t generation;
    std::uint64_t total_bytes;
    std::uint64_t arena_offset[2];
    std::uint64_t arena_bytes[2];
    std::uint64_t created_ns; // CLOCK_MONOTONIC
    std::uint64_t
        superseded_by; // newer generation, written by its creator; 0 = none. Read by std::atomic_ref
    std::uint32_t line_bytes, page_bytes; // `line` and `page` of the build that has made the file
    std::byte unused[page - 96];
};

/// What the owner of a doorbell does, and so what a ringer has to do. awake: set bits. asleep: set bits and
/// wake it. polling: the owner polls its rings by itself, user bits need not be set.
enum class DoorbellOwner : std::uint32_t { awake, asleep, polling };

constexpr std::size_t doorbell_words = 7;

template <class A>
struct alignas(line_pair) BasicDoorbellWords {
    typename A::template Atomic<std::uint64_t> ready[doorbell_words]; // bit i: port i has something to read
    typename A::template Atomic<std::uint32_t> owner; // futex word: DoorbellOwner; in the line of `ready`
    std::byte unused[68];
};
using DoorbellWords = BasicDoorbellWords<RealAtomics>;

enum class ObjectKind : std::uint32_t { ring = 1, call_queue = 2, blob = 3 };

struct DirectoryEntry {
    char name[name_bytes];
    std::uint32_t kind; // ObjectKind
    std::uint32_t unused;
    std::uint64_t offset; // from the start of the owner's arena
    std::uint64_t bytes;
};

struct alignas(line_pair) SideHeader {
    Word32 taken; // 1 once the side has joined, then never reset; set after its lock is held
    Word32 pid;   // with the next three words: the process, see process_identity.hpp
    Word64 joined_ns;
    Word64 pid_namespace, time_namespace, start_ticks;
    Word32 left; // 1 once the side has left cleanly, for observers; set before its lock is given back
    std::byte unused0[84];
    DoorbellWords doorbell;              // of this side: the other rings it
    alignas(line_pair) Word32 published; // 0 = nothing yet, else 1 + number of valid directory entries
    std::byte unused1[124];
    DirectoryEntry directory[max_objects];
};

static_assert(offsetof(SegmentHeader, contract) == 16);
static_assert(offsetof(SegmentHeader, arena_offset) == 40);
static_assert(offsetof(SegmentHeader, superseded_by) == 80);
static_assert(offsetof(SegmentHeader, line_bytes) == 88 && sizeof(SegmentHeader) == page);
static_assert(sizeof(DoorbellWords) == line_pair);
static_assert(sizeof(DirectoryEntry) == 128 && offsetof(DirectoryEntry, offset) == 112);
static_assert(offsetof(SideHeader, pid_namespace) == 16 && offsetof(SideHeader, doorbell) == 128);
static_assert(offsetof(SideHeader, published) == 256 && offsetof(SideHeader, directory) == 384);
static_assert(sizeof(SideHeader) == 384 + max_objects * sizeof(DirectoryEntry));

constexpr std::size_t arenas_begin = 139264; // after both SideHeaders, next page
static_assert(page + 2 * sizeof(SideHeader) <= arenas_begin && arenas_begin % page == 0);

// Ring: RingHeader | data[capacity] | chunks, if it has any (below). A position is a 64-bit count of bytes
// that never wraps around; its place is position % capacity. A record is one or more whole lines, contiguous:
//
//      0        8       16                                    64
//      +--------+-------+-------------------------------------+--------------
//      | commit | stamp | payload: up to 48 bytes share the commit word's line, longer ones go on
//      +--------+-------+-------------------------------------+--------------
//
// The commit word is stored last, and 0 lies where the next record will begin: a reader polls that line only. A
// record that would cross the end of data is preceded by padding up to there (kind = padding).
//
//      commit:  63 .. 32 sequence, low 32 bits | 31 .. 30 kind | 29 sampled | 28 .. 0 payload bytes
//
// A payload longer than max_record lies in a chunk: the record (kind = chunk) then holds { chunk number, bytes }.
enum class RecordKind : std::uint32_t { none, data, padding, chunk };

template <class A>
struct BasicRingHeader {
    using Word64 = typename A::template Atomic<std::uint64_t>;

    std::uint64_t capacity;    // power of two
    std::uint64_t max_record;  // payload bytes in the ring itself; two of the longest records fit
    std::uint64_t chunk_bytes; // whole pages; 0 = no chunks
    std::uint32_t chunks;
    std::uint32_t writer; // Side
    std::byte unused1[96];
    // The writer's line, with its counters: a message touches no more of the header than this line and the reader's.
    alignas(line_pair) Word64 head; // end of the newest record; moved by the writer only
    Word64 newest;                  // start of the newest record; for readers that skip to it
    // The writer has stored, and stores, nothing at or after this position. Stored before what it allows: so an observer
    // knows that what it has copied from `capacity` bytes before it on was whole.
    Word64 write_limit;
    Word64 sent; // counters, see RingCounters
    Word64 overwritten;
    Word64 bytes_sent;
    Word64 published; // records; the sequence number of the newest
    Word64
        sample; // of the newest record that is sampled: 63 .. 16 publication time / 16 ns | 15 .. 0 sequence
    Word64 refused;             // rare
    Word64 converted_by_writer; // counters of the users: see RingCounters
    Word64 waits_for_room; // 1: the writer's user holds a message back while the reader has no room for it
    std::byte unused2[40];
    // The reader's line.
    alignas(line_pair)
        Word64 tail; // start of the oldest record; moved by the reader, or by the writer to drop it
    Word64 received; // counters
    Word64 skipped;
    Word64 bytes_received;
    // The reader reads at most this number of waiting records, the newest, and skips the others; 0 = all. Set by the
    // reader; read by writers that hold messages back, and by observers.
    Word64 depth;
    // If several users share the reader: 1 more than the number of records that may wait without one user losing any; 0: see
    // depth. For writers that hold messages back.
    Word64 room;
    std::byte unused3[16];
    Word64 converted_by_reader; // counters of the users: see RingCounters
    Word64 undecodable;
    Word64 missed_deadlines;
    Word64 discarded;
    std::byte unused4[32];
    alignas(line_pair) Histogram age; // from published to read, of sampled records; counted by the reader
};
using RingHeader = BasicRingHeader<RealAtomics>;

static_assert(offsetof(RingHeader, writer) == 28);
static_assert(offsetof(RingHeader, head) == 128 && offsetof(RingHeader, tail) == 256);
static_assert(offsetof(RingHeader, depth) == 288 && offsetof(RingHeader, converted_by_reader) == 320);
static_assert(offsetof(RingHeader, age) == 384 && sizeof(RingHeader) == 384 + sizeof(Histogram));

constexpr std::size_t record_header = 16;

// Chunks: after data, the ChunkWords of all chunks, then the chunks, each at a page of the file. A chunk belongs
// to the writer until it has published a record that refers to it. It then belongs to the side that takes that
// record off the ring (the reader to read it, the writer to drop it). The reader gives the chunk back by storing
// the record's sequence, or, having skipped that record, any later one up to the one before the record it took.
// Before the first byte of a chunk is written, filled_for is set to the record's sequence.
template <class A>
struct BasicChunkWords {
    template <class T>
    using Atomic = typename A::template Atomic<T>;

    alignas(line_pair) Atomic<std::uint64_t> returned;
    std::byte unused1[56];
    Atomic<std::uint64_t> filled_for; // for observers: sequence of the record for which it was written last
    std::byte unused2[56];
};
using ChunkWords = BasicChunkWords<RealAtomics>;
static_assert(sizeof(ChunkWords) == line_pair);

// Call queue: header, then CallTimes, then slot_count slots, then slot_count overflow buffers of
// overflow_bytes each. A slot is three line pairs. One per direction, because each direction has one writer and one
// poller: a call whose arguments and results are short moves no other line than these. And one for the workers alone,
// which a caller reads only when it waits long or gives up.
//
//          0             8               16          24             32      40
//   request  word (64)   submitted_ns    deadline    caller_asleep  calls   arguments (88)
//   reply    word (64)   results (120)
//   work     claim (64)  progress        answered
//
// What is longer continues in the slot's overflow buffer. A payload longer than short_call_bytes is passed by loan: all of it
// is in the file after total_bytes, at (2 * slot + callers) * max_loan_bytes, and is moved by pwrite() and pread(). A process
// therefore maps no more than before, touches no page that has no memory, and cannot be stopped by a hole that the peer has
// made. The caller gives the memory back after the reply. A segment has at most one queue with loans for each calling side.
//
//      request word:  63 .. 32 payload bytes | 31 .. 4 sequence | 3 .. 0 CallState
//      reply word:    63 .. 32 payload bytes | 31 .. 4 sequence | 3 .. 0 CallStatus
//      claim:         63 .. 32 0             | 31 .. 4 sequence | 3 .. 0 0
//      progress:      63 .. 32 done / 1e-9   | 31 .. 4 sequence | 3 .. 0 0
//
// A worker stores progress while it runs a call that takes long and whose component says how far it is. With another
// sequence it is that of an earlier call.
//
// The sequence counts the calls of the slot. Callers alone write the request word (after their death the server cancels
// what still waits), and workers alone the claim and the reply, so a line changes hands once in each direction. A reply
// belongs to the request with the same sequence, and makes the slot idle again:
//
//           caller               worker: claim has the same sequence       reply word has it, too
//   (idle) ---------> submitted ------------------------------------> runs ----------------------> (idle)
//                         | caller: cancelled                          | caller: cancelled            ^
//                         v                                            v                              |
//                      (idle)                                 runs, nobody waits ---------------------+
//
// A worker that claims and a caller that cancels each store a word of their own and then load the other's; the caller's
// accesses are seq_cst, and between the worker's is a fence, so at least one sees the other. The caller that sees the
// claim keeps the slot until there is a reply. The worker that sees another request word does not run the call, but
// replies: the caller may have seen the claim.
//
// A worker that finds the request word changed while the call runs knows that nobody waits for its results any more. It
// may stop early, but must still answer.
//
// Which slots are idle is known to the callers' process alone: all callers live in one process, its death ends them
// all, and the generation of a dead process gets no other callers. So nothing has to be cleaned up after it.
//
// forgotten: given up because the server is dead, which will not reply, so the slot is idle whatever the claim says.
enum class CallState : std::uint32_t { none, submitted, cancelled, forgotten };

constexpr std::uint64_t short_call_bytes = std::uint64_t{64} << 10;
constexpr std::uint64_t max_loan_bytes = std::uint64_t{64} << 20;

template <class A>
struct alignas(line_pair) BasicCallRequest {
    template <class T>
    using Atomic = typename A::template Atomic<T>;

    Atomic<std::uint64_t> word;
    Atomic<std::uint64_t> submitted_ns;  // CLOCK_MONOTONIC; the oldest call is taken first
    Atomic<std::uint64_t> deadline_ns;   // CLOCK_MONOTONIC
    Atomic<std::uint32_t> caller_asleep; // futex word: 1 = asleep, or about to
    std::uint32_t unused;
    Atomic<std::uint64_t> calls; // counter: submitted in this slot
    typename A::Cell arguments[11];
};

template <class A>
struct alignas(line_pair) BasicCallReply {
    template <class T>
    using Atomic = typename A::template Atomic<T>;

    Atomic<std::uint64_t> word;
    typename A::Cell results[15];
};

template <class A>
struct alignas(line_pair) BasicCallWork {
    template <class T>
    using Atomic = typename A::template Atomic<T>;

    Atomic<std::uint64_t> claim;
    Atomic<std::uint64_t> progress; // of the call that is running
    Atomic<std::uint64_t> answered; // counter: replies given in this slot
};

template <class A>
struct BasicCallSlot {
    BasicCallRequest<A> request;
    BasicCallReply<A> reply;
    BasicCallWork<A> work;
};

template <class A>
struct BasicCallQueueHeader {
    template <class T>
    using Atomic = typename A::template Atomic<T>;

    std::uint32_t slot_count;
    std::uint32_t callers;        // Side
    std::uint64_t max_bytes;      // of arguments, and of results; above short_call_bytes by loan
    std::uint64_t overflow_bytes; // of each overflow buffer
    // Read by callers with every call, written by the server when its workers fall asleep or wake.
    alignas(line_pair) Atomic<std::uint32_t> workers_asleep; // or about to sleep
    Atomic<std::uint32_t> polling;                           // WorkerPolling
    Atomic<std::uint32_t> closed;                            // 1 = no further call will be served
    Atomic<std::uint32_t> wake_count;                        // futex word of sleeping workers
    Atomic<std::uint32_t>
        slots_used; // the indices of all slots that had a call, ORed: none of them is greater
    // Rare events; several threads of the callers' side count them.
    alignas(line_pair) Atomic<std::uint32_t> has_client; // 1 = a CallClient has the calling end
    Atomic<std::uint64_t> overloads;                     // no slot became idle before the deadline
    Atomic<std::uint64_t> timeouts;                      // given up at the deadline
    Atomic<std::uint64_t> cancels;                       // given up before it
    Atomic<std::uint64_t> worker_wakes;                  // system calls to wake a worker
    // Rare events that the server's side counts.
    alignas(line_pair) Atomic<std::uint64_t> expired; // taken after the deadline, not run
    Atomic<std::uint64_t> caller_wakes;               // system calls to wake a caller
};

// Does a worker poll the slots at this moment? no: wake one. yes: one does. soon: it has just answered and is
// expected back; a caller that waits itself may rely on that, because it looks again before it sleeps.
enum class WorkerPolling : std::uint32_t { no, yes, soon };

// The first 1024 calls of each slot, and then every 16th, are timed.
struct alignas(line_pair) CallTimes {
    Histogram round_trip; // from the start of the call to its reply; measured by the caller
    Histogram service;    // from taken to answered; measured by the worker
};

using CallRequest = BasicCallRequest<RealAtomics>;
using CallReply = BasicCallReply<RealAtomics>;
using CallWork = BasicCallWork<RealAtomics>;
using CallSlot = BasicCallSlot<RealAtomics>;
using CallQueueHeader = BasicCallQueueHeader<RealAtomics>;

static_assert(sizeof(CallSlot) == 3 * line_pair && offsetof(CallSlot, reply) == line_pair &&
              offsetof(CallSlot, work) == 2 * line_pair);
static_assert(offsetof(CallRequest, calls) == 32);
static_assert(offsetof(CallRequest, arguments) == 40);
static_assert(offsetof(CallReply, results) == 8);
static_assert(offsetof(CallWork, progress) == 8 && offsetof(CallWork, answered) == 16);
static_assert(offsetof(CallQueueHeader, workers_asleep) == 128 &&
              offsetof(CallQueueHeader, has_client) == 256);
static_assert(offsetof(CallQueueHeader, expired) == 384 && sizeof(CallQueueHeader) == 512);
static_assert(sizeof(CallTimes) == 2048);

} // namespace tandem::shm::layout
