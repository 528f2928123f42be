// SPDX-License-Identifier: Apache-2.0
// What the bytes of a segment mean. This header is the ABI between two processes that may have been built
// apart: any change of a field, its meaning or its place raises layout_version, and a process of another
// version is refused when it joins.
//
// A segment is one *generation* of a link: the file /dev/shm/tandem.<link>.<generation>, joined by two sides.
// Each side owns one half: a SideHeader (who I am, my doorbell, the directory of what I offer) and an arena
// that holds the objects themselves. A side takes a generation once; after its death the generation is never
// reopened, the next one gets a new name. So nothing here is ever reset, and there is no state to repair.
//
//      0 +---------------------------+
//        | SegmentHeader             |  written before the file has a name; only superseded_by changes later
//  4 KiB +---------------------------+
//        | SideHeader of first       |  identity | heartbeat | doorbell | published | directory[512]
//        +---------------------------+
//        | SideHeader of second      |
//        +---------------------------+  arena_offset[0], page aligned
//        | arena of first            |  objects of first: RingHeader + bytes | CallQueueHeader + CallTimes +
//        slots | blobs
//        +---------------------------+  arena_offset[1]
//        | arena of second           |
//        +---------------------------+  total_bytes = size of the file, reserved and touched at creation; or,
//        if
//                                       it was made sparse, object by object when they are added, and of the
//                                       chunks of rings (below) what is used, when it is first used
//
// Not in the bytes, but on them: three byte-range locks (OFD) on the file. Byte 0 is held for life by first,
// byte 1 by second, byte 2 while somebody creates, joins, leaves or removes. (liveness.hpp)
//
// Written under the assumption that the other side changes every byte at any time: sizes and offsets are
// copied once, checked, and then only the copy is used. (The *size* of the file: whoever may write the file
// may also truncate it, which ends its users by SIGBUS, unless they have called install_truncation_guard(),
// as proxy/link does. The same if it lends a chunk without memory from a sparse segment when /dev/shm is
// full. Mode 0600 keeps that among processes of one user.)
//
// Words that change while both sides look are std::atomic; they stand on cache-line pairs of their own,
// because the hardware fetches lines in pairs.
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

constexpr std::uint64_t magic = 0x31304d45444e4154; // "TANDEM01" read as bytes
constexpr std::uint32_t layout_version = 2;
constexpr std::size_t page = 4096;
constexpr std::size_t line = 64;
constexpr std::size_t line_pair = 128;
constexpr std::size_t max_objects = 512;
constexpr std::size_t name_bytes = 104; // with the terminating zero

struct SegmentHeader {
    std::uint64_t magic;
    std::uint32_t layout_version;
    std::uint32_t header_bytes; // offset of the first SideHeader
    std::uint64_t contract;     // version of what the users of the segment agree on, opaque here
    std::uint64_t generation;
    std::uint64_t total_bytes;
    std::uint64_t arena_offset[2];
    std::uint64_t arena_bytes[2];
    std::uint64_t created_ns; // CLOCK_MONOTONIC
    std::uint64_t
        superseded_by; // newer generation, written by its creator; 0 = none. Read by std::atomic_ref
    std::byte unused[4096 - 88];
};

/// What the owner of a doorbell does, and so what a ringer has to do. listens: set bits. sleeps: set bits and
/// wake. looks: at its rings by itself; user bits need not be set.
enum class DoorbellOwner : std::uint32_t { listens, sleeps, looks };

constexpr std::size_t doorbell_words = 7;

template <class A>
struct alignas(line_pair) BasicDoorbellWords {
    typename A::template Atomic<std::uint64_t> ready[doorbell_words]; // bit i: something is ready at port i
    typename A::template Atomic<std::uint32_t> owner; // futex word: DoorbellOwner; in the same line
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
    Word32 taken; // 1 once the side has joined, for ever; set after its lock is held
    Word32 pid;   // for messages to people only
    Word64 joined_ns;
    std::byte unused0[112];
    alignas(line_pair) Word64 heartbeat_ns; // CLOCK_MONOTONIC
    std::byte unused1[120];
    DoorbellWords doorbell;              // of this side: the other rings it
    alignas(line_pair) Word32 published; // 0 = nothing yet, else 1 + number of valid directory entries
    std::byte unused2[124];
    DirectoryEntry directory[max_objects];
};

static_assert(offsetof(SegmentHeader, contract) == 16);
static_assert(offsetof(SegmentHeader, arena_offset) == 40);
static_assert(offsetof(SegmentHeader, superseded_by) == 80);
static_assert(sizeof(SegmentHeader) == page);
static_assert(sizeof(DoorbellWords) == line_pair);
static_assert(sizeof(DirectoryEntry) == 128 && offsetof(DirectoryEntry, offset) == 112);
static_assert(offsetof(SideHeader, heartbeat_ns) == 128 && offsetof(SideHeader, doorbell) == 256);
static_assert(offsetof(SideHeader, published) == 384 && offsetof(SideHeader, directory) == 512);
static_assert(sizeof(SideHeader) == 512 + max_objects * sizeof(DirectoryEntry));

constexpr std::size_t arenas_begin = 139264; // behind both SideHeaders, next page
static_assert(page + 2 * sizeof(SideHeader) <= arenas_begin && arenas_begin % page == 0);

// Ring: RingHeader | data[capacity] | chunks, if it has any (below). A position is a 64-bit count of bytes
// that never wraps; its place is position % capacity. A record is one or more whole lines, contiguous:
//
//      0        8       16                                    64
//      +--------+-------+-------------------------------------+--------------
//      | commit | stamp | payload: up to 48 bytes share the commit word's line, longer ones go on
//      +--------+-------+-------------------------------------+--------------
//
// The commit word is stored last and 0 stands where the next record will begin, so a reader looks at that one
// line until there is news, and the news has then come with it. A record that would cross the end is preceded
// by padding up to there (kind = padding).
//
//      commit:  63 .. 40 sequence, low 24 bits | 39 .. 32 tag | 31 .. 30 kind | 29 .. 0 payload bytes
//
// A payload longer than max_record lies in a chunk: the record (kind = loan) then holds { chunk number, bytes
// }.
enum class RecordKind : std::uint32_t { none, record, padding, loan };

template <class A>
struct BasicRingHeader {
    using Word32 = typename A::template Atomic<std::uint32_t>;
    using Word64 = typename A::template Atomic<std::uint64_t>;

    std::uint64_t capacity;    // power of two
    std::uint64_t max_record;  // payload bytes in the ring itself; two of the longest records fit
    std::uint64_t chunk_bytes; // whole pages; 0 = no chunks
    std::uint32_t chunks;
    std::uint32_t policy; // RingPolicy
    std::uint32_t writer; // Side
    std::uint32_t unused0;
    std::uint64_t wait_ns; // bound of RingPolicy::wait
    std::byte unused1[80];
    // The writer's line: few ports or many, a message touches no more of the header than this and the next.
    alignas(line_pair) Word64 head; // end of the newest record; moved by the writer only
    Word64 newest;                  // begin of the newest record; both for those who come later or skip
    Word64 sent;                    // counters, see RingCounters
    Word64 refused;
    Word64 overwritten;
    Word64 bytes_sent;
    Word64 published; // records; the sequence number of the newest
    Word64 sample;    // when a record was published: 63 .. 16 time / 16 ns | 15 .. 0 sequence / 64
    std::byte unused2[64];
    // The reader's line.
    alignas(line_pair) Word64 tail; // begin of the oldest record; moved by the reader, in lossy rings also by
                                    // the writer
    Word64 received;                // counters
    Word64 skipped;
    Word64 bytes_received;
    Word32 writer_sleeps; // futex word of RingPolicy::wait
    std::byte unused3[92];
    alignas(line_pair) Histogram age; // from published to read, of every 64th record; by the reader
};
using RingHeader = BasicRingHeader<RealAtomics>;

static_assert(offsetof(RingHeader, wait_ns) == 40);
static_assert(offsetof(RingHeader, head) == 128 && offsetof(RingHeader, tail) == 256);
static_assert(offsetof(RingHeader, age) == 384 && sizeof(RingHeader) == 384 + sizeof(Histogram));

constexpr std::size_t record_header = 16;
constexpr std::uint64_t sequence_mask = 0xffffff; // of a commit word

// Chunk: behind data, ChunkWords of all chunks, then the chunks, each at a page of the file. Who may touch a
// chunk: the writer, until it has published a loan of it; then whoever takes that record off the ring (the
// reader to read it, a lossy writer to drop it); the reader gives it back by storing the record's sequence,
// or, having skipped that record, any later one up to the one before the record it took.
template <class A>
struct BasicChunkWords {
    alignas(line_pair)
        typename A::template Atomic<std::uint64_t> returned; // loans up to this sequence are given back
    std::byte unused[120];
};
using ChunkWords = BasicChunkWords<RealAtomics>;
static_assert(sizeof(ChunkWords) == line_pair);

// Call queue: header, then CallTimes, then slot_count slots, then slot_count overflow buffers of
// overflow_bytes each. A slot is two line pairs, one per direction, because each direction has one writer and
// one poller. A call whose arguments and results are short moves no other line than these:
//
//          0             8                   16          24             32      40
//   request  word (64)   operation | ticket  deadline    caller_sleeps  calls   arguments (88)
//   reply    word (64)   answered            results (112)
//
// What is longer goes on in the slot's overflow buffer (arguments from their byte 88 on, results from 112
// on). Request word: state (4 bits) | sequence (28) | length in bytes (32); reply word: status (4) | sequence
// (28) | length (32). The sequence counts the calls of the slot; a reply belongs to the request that has the
// same one, and that makes the slot idle again without a further write to a shared line:
//
//           caller               worker               reply word has the same sequence
//   (idle) ---------> submitted ---------> running -------------------------------------> (idle)
//                         | caller gave up    | caller gave up                              ^
//                         v                   v                                             |
//                     cancelled (idle)    abandoned ----------------------------------------+
//
// Which idle slots are whose is known to the callers' process alone: callers live in one process, its death
// ends them all, and a dead process' generation has no other callers. Nothing has to be cleaned up for it.
enum class CallState : std::uint32_t { none, submitted, running, cancelled, abandoned };

template <class A>
struct alignas(line_pair) BasicCallRequest {
    typename A::template Atomic<std::uint64_t> word; // the caller's, but submitted -> running by a worker
    typename A::template Atomic<std::uint64_t> what; // operation (32 bits) | ticket: submission time in us
    typename A::template Atomic<std::uint64_t> deadline_ns;   // CLOCK_MONOTONIC
    typename A::template Atomic<std::uint32_t> caller_sleeps; // futex word
    std::uint32_t unused;
    typename A::template Atomic<std::uint64_t> calls; // counter: submitted in this slot
    typename A::Cell arguments[11];
};

template <class A>
struct alignas(line_pair) BasicCallReply {
    typename A::template Atomic<std::uint64_t> word;
    typename A::template Atomic<std::uint64_t> answered; // counter: replies given in this slot
    typename A::Cell results[14];
};

template <class A>
struct BasicCallSlot {
    BasicCallRequest<A> request;
    BasicCallReply<A> reply;
};

template <class A>
struct BasicCallQueueHeader {
    std::uint32_t slot_count;
    std::uint32_t callers;        // Side
    std::uint64_t max_bytes;      // of arguments, and of results
    std::uint64_t overflow_bytes; // of each overflow buffer
    // Read by callers with every call, written by the server when its workers fall asleep or wake.
    alignas(line_pair) typename A::template Atomic<std::uint32_t> sleepers; // workers asleep or about to
    typename A::template Atomic<std::uint32_t> watching;                    // CallWatch
    typename A::template Atomic<std::uint32_t> closed; // 1 = no further call will be served
    typename A::template Atomic<std::uint32_t> rung;   // futex word of sleeping workers
    // Events that are rare; several threads of the callers' side count them.
    alignas(line_pair) typename A::template Atomic<std::uint32_t> calling; // 1 = a CallClient has this end
    typename A::template Atomic<std::uint64_t> overloads;                  // refused: no idle slot
    typename A::template Atomic<std::uint64_t> timeouts;                   // given up at the deadline
    typename A::template Atomic<std::uint64_t> cancels;                    // given up for cancel or shut-down
    typename A::template Atomic<std::uint64_t> worker_wakes;               // system calls to wake a worker
    // The same of the server's side.
    alignas(line_pair)
        typename A::template Atomic<std::uint64_t> expired;  // taken after the deadline, not run
    typename A::template Atomic<std::uint64_t> caller_wakes; // system calls to wake a caller
};

// Does a worker look at the slots at this moment? no: wake one. yes: it polls. soon: it has just answered and
// is expected back; a caller that waits itself may rely on that, because it looks again before it sleeps.
enum class CallWatch : std::uint32_t { no, yes, soon };

// Every 16th call of a slot is timed (the first 1024 all), by the side that waits or works.
struct alignas(line_pair) CallTimes {
    Histogram round_trip; // begin of the call to its reply, as the caller sees it
    Histogram service;    // taken to answered, as the server sees it
};

using CallRequest = BasicCallRequest<RealAtomics>;
using CallReply = BasicCallReply<RealAtomics>;
using CallSlot = BasicCallSlot<RealAtomics>;
using CallQueueHeader = BasicCallQueueHeader<RealAtomics>;

static_assert(sizeof(CallSlot) == 2 * line_pair && offsetof(CallSlot, reply) == line_pair);
static_assert(offsetof(CallRequest, calls) == 32);
static_assert(offsetof(CallRequest, arguments) == 40);
static_assert(offsetof(CallReply, results) == 16);
static_assert(offsetof(CallQueueHeader, sleepers) == 128 && offsetof(CallQueueHeader, calling) == 256);
static_assert(offsetof(CallQueueHeader, expired) == 384 && sizeof(CallQueueHeader) == 512);
static_assert(sizeof(CallTimes) == 2048);

} // namespace tandem::shm::layout
