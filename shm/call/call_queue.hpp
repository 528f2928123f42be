// SPDX-License-Identifier: Apache-2.0
// Calls from many threads of one side to many workers of the other. Bounded: a fixed number of slots, a
// deadline on every call, no queue behind the slots. Each call runs at most once.
//
// Calls may be nested: a worker may call back through a queue of the other direction, to any depth. Each
// level holds one slot and one worker of its queue until the levels below have returned, so a chain that
// enters a queue n times needs n slots and n workers there (for each such chain at a time). With too few
// slots the innermost call ends at once with overload, with too few workers at its deadline with timeout:
// never in a deadlock.
#pragma once
#include "shm/call/call_view.hpp"
#include "shm/segment/mapping.hpp"

#include <memory>
#include <vector>

namespace tandem::shm {

enum class CallStatus : std::uint32_t {
    ok,
    no_such_operation,
    bad_arguments,
    exception,
    timeout,
    peer_died,
    overload,
    shut_down,
    cancelled
};
const char* name_of(CallStatus status);

struct CallQueueOptions {
    Side callers = Side::first;
    std::uint32_t slots = 16;                       ///< calls in progress at once; 1 to 256
    std::size_t max_bytes = std::size_t{64} * 1024; ///< of the arguments, and of the results
};

using CallView = BasicCallView<RealAtomics>;

/// A call queue found or made by Segment: its place, and this process's own copy of its sizes.
struct CallQueueHandle {
    std::shared_ptr<const Mapping> mapping;
    CallView view;
    layout::CallTimes* times;
    Side callers;
};

/// calls: submitted. answered: by a worker, whether or not somebody still waited; of these, expired were not
/// run because their deadline was over. in_use: slots with a call that is not answered, taken: answered, and
/// in use by a worker. worker_wakes, caller_wakes: system calls that were needed to wake somebody.
struct CallCounters {
    std::uint64_t calls, overloads, timeouts, cancels, taken, answered, expired, in_use, worker_wakes,
        caller_wakes;
};
CallCounters read_counters(const CallView& queue); ///< [any-process]

/// Adds what the words of one slot say (answered and the reply's word are to be read first).
void count_slot(CallCounters& sum, std::uint64_t answered, std::uint64_t reply_word,
                std::uint64_t request_word, std::uint64_t calls);

/// The parts of a call queue in memory that anybody may have written. Throws Error if they are not sound;
/// `where` begins its text.
struct CallQueueParts {
    CallView view;
    layout::CallTimes* times;
    Side callers;
};
CallQueueParts find_call_queue_parts(std::span<std::byte> memory, const std::string& where);

/// What a call queue takes in an arena; 0 if there is no such call queue.
std::uint64_t call_queue_size(const CallQueueOptions& options);

// Used by Segment.
std::uint64_t call_queue_bytes(const std::string& name, const CallQueueOptions& options); ///< Throws Error.
CallQueueHandle create_call_queue(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                                  const CallQueueOptions& options);
CallQueueHandle open_call_queue(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                                const std::string& name);

} // namespace tandem::shm
