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
//        | arena of first            |  objects of first: RingHeader + bytes | CallQueueHeader + slots |
//        blobs
//        +---------------------------+  arena_offset[1]
//        | arena of second           |
//        +---------------------------+  total_bytes = size of the file, reserved and touched at creation
//
// Not in the bytes, but on them: three byte-range locks (OFD) on the file. Byte 0 is held for life by first,
// byte 1 by second, byte 2 while somebody creates, joins, leaves or removes. (liveness.hpp)
//
// Written under the assumption that the other side changes every byte at any time: sizes and offsets are
// copied once, checked, and then only the copy is used. (The *size* of the file is not defended: whoever may
// write the file may also truncate it, which ends its users by SIGBUS. Mode 0600 keeps that among processes
// of one user.)
//
// Words that change while both sides look are std::atomic; they stand on cache-line pairs of their own,
// because the hardware fetches lines in pairs.
#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace tandem::shm::layout {

using Word32 = std::atomic<std::uint32_t>;
using Word64 = std::atomic<std::uint64_t>;
static_assert(Word32::is_always_lock_free && sizeof(Word32) == 4);
static_assert(Word64::is_always_lock_free && sizeof(Word64) == 8);

constexpr std::uint64_t magic = 0x31304d45444e4154; // "TANDEM01" read as bytes
constexpr std::uint32_t layout_version = 1;
constexpr std::size_t page = 4096;
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

struct alignas(line_pair) DoorbellWords {
    Word64 ready;    // bit i: something is ready at the user's port i
    Word32 sleeping; // futex word: 1 = the owner sleeps or is about to
    std::byte unused[116];
};

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

// Ring: bytes [0, capacity) follow the header; a position is a 64-bit count of bytes that never wraps, its
// place is position % capacity. Records lie contiguous between tail and head, each RecordHeader + payload,
// rounded up to 8. One that would cross the end is preceded by padding: a first word with length
// padding_length, up to the end.
struct RingHeader {
    std::uint64_t capacity;   // power of two
    std::uint64_t max_record; // payload bytes; two of the longest records fit
    std::uint32_t policy;     // RingPolicy
    std::uint32_t writer;     // Side
    std::uint64_t wait_ns;    // bound of RingPolicy::wait
    std::byte unused0[96];
    alignas(line_pair) Word64 head; // end of the newest record; moved by the writer only
    Word64 newest;                  // begin of the newest record; stored after head
    std::byte unused1[112];
    alignas(line_pair)
        Word64 tail; // begin of the oldest record; moved by the reader, in lossy rings also by the writer
    Word32 writer_sleeps; // futex word of RingPolicy::wait
    std::byte unused2[116];
    alignas(line_pair) Word64 sent; // counters of the writer, see RingCounters
    Word64 refused;
    Word64 overwritten;
    Word64 bytes_sent;
    std::byte unused3[96];
    alignas(line_pair) Word64 received; // counters of the reader
    Word64 skipped;
    Word64 bytes_received;
    std::byte unused4[104];
};

struct RecordHeader {
    std::uint32_t length; // payload bytes, or padding_length
    std::uint32_t tag;
    std::uint64_t sequence; // 1, 2, 3 ... without a gap
    std::uint64_t stamp_ns;
};
constexpr std::uint32_t padding_length = 0xffffffff;

static_assert(offsetof(RingHeader, head) == 128 && offsetof(RingHeader, tail) == 256);
static_assert(offsetof(RingHeader, sent) == 384 && offsetof(RingHeader, received) == 512);
static_assert(sizeof(RingHeader) == 640);
static_assert(sizeof(RecordHeader) == 24);

// Call queue: slot_count slots follow the header, each CallSlot + max_bytes (rounded up to a line pair). The
// buffer holds the arguments while the state is submitted, the results from replied on.
//
//          caller             caller              worker             worker             caller
//   free ---------> claimed ---------> submitted ---------> running ---------> replied ---------> free
//                                          |                   | caller gave up           (also: server, when
//                                          | caller gave up    v                           the caller is
//                                          dead)
//                                          +--> free       abandoned -- worker done --> free
enum class SlotState : std::uint32_t { free, claimed, submitted, running, replied, abandoned };

struct CallSlot {
    Word32 state;         // SlotState
    Word32 caller_sleeps; // futex word
    Word64 ticket;        // order of submission
    Word64 deadline_ns;   // CLOCK_MONOTONIC
    Word32 operation;
    Word32 status; // CallStatus
    Word64 length; // bytes of arguments or results
    std::byte unused[88];
};

struct CallQueueHeader {
    std::uint32_t slot_count;
    std::uint32_t callers;    // Side
    std::uint64_t max_bytes;  // of arguments, and of results
    std::uint64_t slot_bytes; // from slot to slot
    std::byte unused0[104];
    alignas(line_pair) Word32 submissions; // futex word of idle workers; grows with every call
    Word32 sleepers;                       // workers asleep
    Word32 closed;                         // 1 = no further call will be served
    std::byte unused1[116];
    alignas(line_pair) Word64 tickets; // counters of the callers; tickets = calls submitted
    Word64 overloads;
    Word64 timeouts;
    std::byte unused2[104];
    alignas(line_pair) Word64 taken; // counters of the server
    Word64 answered;
    std::byte unused3[112];
};

static_assert(sizeof(CallSlot) == line_pair && offsetof(CallSlot, length) == 32);
static_assert(offsetof(CallQueueHeader, submissions) == 128 && offsetof(CallQueueHeader, tickets) == 256);
static_assert(sizeof(CallQueueHeader) == 512);

} // namespace tandem::shm::layout
