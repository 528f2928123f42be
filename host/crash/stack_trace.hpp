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
    std::array<std::uintptr_t, 40> address{}; ///< of the instruction, then of the calls that led to it
    std::size_t size = 0;
};

/// The calls that led to the instruction at which a signal has interrupted this thread; to be called by the signal's
/// handler. A call of an address without code (a null function pointer) is left out of the unwinding and listed
/// first. [async-signal-safe]
StackTrace interrupted_calls(ucontext_t& context);

/// Whether the interrupted thread was using memory beyond the end of its stack. [async-signal-safe]
bool is_stack_overflow(const ucontext_t& context, std::uintptr_t fault_address);

/// The calls that led to the one which returns to `return_address`, with it first. [async-signal-safe]
StackTrace calls_from(std::uintptr_t return_address);

} // namespace tandem::crash
