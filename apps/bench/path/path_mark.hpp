// SPDX-License-Identifier: Apache-2.0
// The marks between which a traced thread's instructions are counted.
#pragma once

namespace tandem::bench {

/// The position of a thread. `nothing`: the operation that had begun could not be performed, because the link
/// is not up yet.
enum class PathMark : int {
    none,
    send_begin,
    send_end,
    receive_begin,
    receive_end,
    call_begin,
    call_end,
    served,
    nothing
};

/// Stops this thread until the tracer continues it. Without a tracer, the process ends by SIGTRAP.
inline void mark(PathMark place) {
#if defined(__x86_64__)
    // The tracer reads the mark in rdi. It steps from the instruction after int3 to the next int3.
    asm volatile("int3" : : "D"(static_cast<long>(place)) : "memory");
#else
    static_cast<void>(place); // no tracer
#endif
}

} // namespace tandem::bench
