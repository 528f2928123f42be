// SPDX-License-Identifier: Apache-2.0
// A call queue carries calls from many threads of one side to many workers of the other side. It is bounded: it has a fixed
// number of slots and a deadline for every call. A caller that finds no slot waits for one up to its deadline, and callers
// get slots in the order in which they came. Each call runs at most once.
//
// Calls may be nested to any depth: a worker may call back through a queue of the other direction. Each level holds one
// slot and one worker of its queue until the levels below have returned. A chain that enters a queue n times therefore
// needs n slots and n workers there, for each such chain at a time. Nesting never deadlocks: the innermost call ends at its
// deadline, with overload if there are too few slots, with timeout if there are too few workers.
#pragma once
#include "shm/call/call_view.hpp"
#include "shm/segment/mapping.hpp"

#include <memory>
#include <vector>

namespace tandem::shm {

const char* name_of(CallStatus status);

struct CallQueueOptions {
    Side callers = Side::first;
    std::uint32_t slots = 16; ///< calls in progress at once; 1 to 256
    /// Of the arguments, and of the results; up to 64 MiB. Those longer than 64 KiB are on loan: they take memory of /dev/shm
    /// during the call only.
    std::size_t max_bytes = layout::short_call_bytes;
};

using CallView = BasicCallView<RealAtomics>;

/// A call queue that Segment has found or created. CallClient and CallServer are constructed from it.
struct CallQueueHandle {
    std::shared_ptr<const Mapping> mapping;
    CallView view;
    layout::CallTimes* times;
    Side callers;
};

/// calls: submitted. answered: by a worker, whether or not the caller still waited; expired: the part of these that did not
/// run, because their deadline had passed. in_use: slots with an unanswered call. taken: answered, or in use by a worker.
/// cancels: given up before the deadline, by cancellation or shut-down. worker_wakes, caller_wakes: system calls that woke
/// a worker or a caller.
struct CallCounters {
    std::uint64_t calls, overloads, timeouts, cancels, taken, answered, expired, in_use, worker_wakes,
        caller_wakes;
};
CallCounters read_counters(const CallView& queue); ///< [any-process]

/// The words of a slot that an observer reads. It must read `answered` and the reply's word first, so that it never counts
/// more calls as answered than as submitted.
struct CallSlotWords {
    std::uint64_t answered, reply, claim, request, calls;
};

/// given_up: the call runs, but its caller no longer waits.
enum class CallStage { none, waiting, running, given_up };
CallStage stage_of(const CallSlotWords& slot); ///< Returns none if there is no call, or it is over.

/// Adds the calls that a slot has counted.
void count_slot(CallCounters& sum, const CallSlotWords& slot);

/// Returns the number of bytes that a call queue takes in an arena; 0 for invalid options.
std::uint64_t call_queue_size(const CallQueueOptions& options);

// Used by Segment.

/// The memory of a call queue in an arena, bytes. idle: needed before the first call whose arguments or results do not fit
/// into a slot. Throws Error for invalid options.
struct CallQueueMemory {
    std::uint64_t total, idle;
};
CallQueueMemory call_queue_memory(const std::string& name, const CallQueueOptions& options);
CallQueueHandle create_call_queue(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                                  const CallQueueOptions& options);
/// Opens a call queue in memory that the peer may have written. Throws Error if it does not hold a valid call queue.
CallQueueHandle open_call_queue(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                                const std::string& name);

} // namespace tandem::shm
