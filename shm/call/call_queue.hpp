// SPDX-License-Identifier: Apache-2.0
// A call queue carries calls from many threads of one side to many workers of the other. It is bounded: a
// fixed number of slots, a deadline on every call, no queue behind the slots. Each call runs at most once.
//
// Calls may be nested: a worker may call back through a queue of the other direction, to any depth. Each level holds
// one slot and one worker of its queue until the levels below have returned, so a chain that enters a queue n times
// needs n slots and n workers there (for each such chain at a time). With too few slots the innermost call ends at
// once with overload, with too few workers at its deadline with timeout: never in a deadlock.
#pragma once
#include "shm/call/call_view.hpp"
#include "shm/segment/mapping.hpp"

#include <memory>
#include <vector>

namespace tandem::shm {

const char* name_of(CallStatus status);

struct CallQueueOptions {
    Side callers = Side::first;
    std::uint32_t slots = 16;                       ///< calls in progress at once; 1 to 256
    std::size_t max_bytes = std::size_t{64} * 1024; ///< of the arguments, and of the results
};

using CallView = BasicCallView<RealAtomics>;

/// A call queue found or made by Segment, to make a CallClient or a CallServer from.
struct CallQueueHandle {
    std::shared_ptr<const Mapping> mapping;
    CallView view;
    layout::CallTimes* times;
    Side callers;
};

/// calls: submitted. answered: by a worker, whether or not the caller still waited; of these, expired were
/// not run, because their deadline was over. in_use: slots with a call that is not answered. taken: answered,
/// or in use by a worker. cancels: given up before
/// it, by cancellation or for shut-down. worker_wakes, caller_wakes: system calls made to
/// wake a worker or a caller.
struct CallCounters {
    std::uint64_t calls, overloads, timeouts, cancels, taken, answered, expired, in_use, worker_wakes,
        caller_wakes;
};
CallCounters read_counters(const CallView& queue); ///< [any-process]

/// What an observer reads of a slot. `answered` and the reply's word are to be read first, so that no more calls are
/// counted as answered than as submitted.
struct CallSlotWords {
    std::uint64_t answered, reply, claim, request, calls;
};

/// given_up: runs, but its caller does not wait any more.
enum class CallStage { none, waiting, running, given_up };
CallStage stage_of(const CallSlotWords& slot); ///< none: there is no call, or it is over

/// Adds the calls that a slot tells of.
void count_slot(CallCounters& sum, const CallSlotWords& slot);

/// Bytes that a call queue takes in an arena; 0 for options that no call queue can have.
std::uint64_t call_queue_size(const CallQueueOptions& options);

// Used by Segment.

/// Bytes that a call queue takes in an arena. idle: those that it needs before the first call whose arguments or
/// results do not fit into a slot. Throws Error for options that no call queue can have.
struct CallQueueMemory {
    std::uint64_t total, idle;
};
CallQueueMemory call_queue_memory(const std::string& name, const CallQueueOptions& options);
CallQueueHandle create_call_queue(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                                  const CallQueueOptions& options);
/// Throws Error if the memory, which the peer may have written, does not hold a sound call queue.
CallQueueHandle open_call_queue(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                                const std::string& name);

} // namespace tandem::shm
