// SPDX-License-Identifier: Apache-2.0
// Calls from many threads of one side to many workers of the other. Bounded: a fixed number of slots, a
// deadline on every call, no queue behind the slots. Each call runs at most once.
#pragma once
#include "shm/mapping.hpp"

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
    shut_down
};
const char* name_of(CallStatus status);

struct CallQueueOptions {
    Side callers = Side::first;
    std::uint32_t slots = 16;                       ///< calls in progress at once; 1 to 256
    std::size_t max_bytes = std::size_t{64} * 1024; ///< of the arguments, and of the results
};

/// A call queue found or made by Segment: its place, and this process's own copy of its sizes.
struct CallQueueHandle {
    std::shared_ptr<const Mapping> mapping;
    layout::CallQueueHeader* shared;
    std::byte* slots;
    std::uint32_t slot_count;
    std::uint64_t max_bytes, slot_bytes;
    Side callers;

    layout::CallSlot& slot(std::uint32_t index) const {
        return *reinterpret_cast<layout::CallSlot*>(slots + index * slot_bytes);
    }
    std::byte* buffer(std::uint32_t index) const {
        return slots + index * slot_bytes + sizeof(layout::CallSlot);
    }
};

/// calls = submitted; taken and answered are the server's view. in_use: slots that are not free now.
struct CallCounters {
    std::uint64_t calls, overloads, timeouts, taken, answered, in_use;
};
CallCounters read_counters(const CallQueueHandle& queue); ///< [any-process]

// Used by Segment.
std::uint64_t call_queue_bytes(const std::string& name, const CallQueueOptions& options); ///< Throws Error.
CallQueueHandle create_call_queue(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                                  const CallQueueOptions& options);
CallQueueHandle open_call_queue(std::shared_ptr<const Mapping> mapping, std::span<std::byte> memory,
                                const std::string& name);

} // namespace tandem::shm
