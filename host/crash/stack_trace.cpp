// SPDX-License-Identifier: Apache-2.0
// Uses the unwinder of the C++ run time (libgcc), which finds its tables without a lock, through _dl_find_object().
// libunwind would add a second implementation of the functions that unwind exceptions.
#include "host/crash/stack_trace.hpp"

#include <dlfcn.h>
#include <unwind.h>

namespace tandem::crash {
namespace {

struct Collector {
    StackTrace& trace;
    std::uintptr_t first; ///< the frames inside this one belong to the handler
    bool found = false;
};

_Unwind_Reason_Code collect(_Unwind_Context* context, void* argument) {
    auto& collector = *static_cast<Collector*>(argument);
    StackTrace& trace = collector.trace;
    int before_instruction = 0;
    const std::uintptr_t ip = _Unwind_GetIPInfo(context, &before_instruction);
    collector.found = collector.found || ip == collector.first;
    if (!collector.found) return _URC_NO_REASON;
    if (ip == 0 || trace.size == trace.address.size()) return _URC_END_OF_STACK;
    // A return address may be the first one of the next function, but the byte before it belongs to the call.
    trace.address[trace.size++] = before_instruction != 0 ? ip : ip - 1;
    return _URC_NO_REASON;
}

void append_calls(StackTrace& trace, std::uintptr_t first) {
    Collector collector{trace, first};
    _Unwind_Backtrace(collect, &collector);
}

#if defined(__x86_64__)
std::uintptr_t instruction(const ucontext_t& context) {
    return static_cast<std::uintptr_t>(context.uc_mcontext.gregs[REG_RIP]);
}
std::uintptr_t stack_pointer(const ucontext_t& context) {
    return static_cast<std::uintptr_t>(context.uc_mcontext.gregs[REG_RSP]);
}
/// Restores the caller's state from the state just after a call: the return address is on top of the stack.
void undo_call(ucontext_t& context) {
    auto& stack = context.uc_mcontext.gregs[REG_RSP];
    context.uc_mcontext.gregs[REG_RIP] = *reinterpret_cast<const greg_t*>(stack); // NOLINT
    stack += static_cast<greg_t>(sizeof(greg_t));
}
#elif defined(__aarch64__)
std::uintptr_t instruction(const ucontext_t& context) { return context.uc_mcontext.pc; }
std::uintptr_t stack_pointer(const ucontext_t& context) { return context.uc_mcontext.sp; }
/// Restores the caller's state from the state just after a call: the return address is in the link register.
void undo_call(ucontext_t& context) { context.uc_mcontext.pc = context.uc_mcontext.regs[30]; }
#else
#error "host/crash: say here where this processor's ucontext_t has the instruction's address"
#endif

bool is_code(std::uintptr_t address) {
    dl_find_object found{};
    auto* const code = reinterpret_cast<void*>(address); // NOLINT(performance-no-int-to-ptr)
    return _dl_find_object(code, &found) == 0;
}

} // namespace

StackTrace interrupted_calls(ucontext_t& context) {
    StackTrace trace;
    const std::uintptr_t at = instruction(context);
    if (!is_code(at)) {
        trace.address[trace.size++] = at;
        undo_call(context);
    }
    append_calls(trace, instruction(context));
    if (trace.size == 0) trace.address[trace.size++] = at; // the unwinder did not get out of the handler
    return trace;
}

// A function first moves the stack pointer by the size of its variables and then uses them. Therefore memory near the
// stack pointer exists, unless the stack ends there.
bool is_stack_overflow(const ucontext_t& context, std::uintptr_t fault_address) {
    constexpr std::uintptr_t reach = std::uintptr_t{64} << 10;
    return fault_address + reach > stack_pointer(context) && fault_address < stack_pointer(context) + reach;
}

StackTrace calls_from(std::uintptr_t return_address) {
    StackTrace trace;
    append_calls(trace, return_address);
    return trace;
}

} // namespace tandem::crash
