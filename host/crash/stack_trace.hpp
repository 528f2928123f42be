// SPDX-License-Identifier: Apache-2.0
// Internal to host/crash.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <ucontext.h>

namespace tandem::crash {

/// The innermost calls of the calling thread.
struct StackTrace {
    std::array<std::uintptr_t, 40> address{}; ///< the instruction, then the calls that led to it
    std::size_t size = 0;
};

/// Returns the calls that led to the instruction at which a signal has interrupted this thread. For use in the
/// signal's handler. A call to an address without code (a null function pointer) is listed first and skipped in
/// unwinding. [async-signal-safe]
StackTrace interrupted_calls(ucontext_t& context);

/// Returns true if the interrupted thread used memory beyond the end of its stack. [async-signal-safe]
bool is_stack_overflow(const ucontext_t& context, std::uintptr_t fault_address);

/// Returns the calls that led to the call with this `return_address`, beginning with that call. [async-signal-safe]
StackTrace calls_from(std::uintptr_t return_address);

} // namespace tandem::crash
