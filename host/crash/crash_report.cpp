// SPDX-License-Identifier: Apache-2.0
// The code that runs after the fault is async-signal-safe: it allocates no memory and takes no lock.
#include "host/crash/crash_report.hpp"

#include "host/crash/alternate_stack.hpp"
#include "host/crash/callback_scope.hpp"
#include "host/crash/code_location.hpp"
#include "host/crash/held_locks.hpp"
#include "host/crash/stack_trace.hpp"
#include "host/crash/text_buffer.hpp"

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <cxxabi.h>
#include <exception>
#include <string_view>
#include <sys/prctl.h>
#include <typeinfo>
#include <unistd.h>

namespace tandem::crash {
namespace {

constexpr unsigned max_report_seconds = 10;

const char* program_name = "host";
std::atomic<pid_t> reporting_thread{0}, ending_thread{0};
TextBuffer report; // written by the reporting thread

/// Restores a signal's default action and unblocks the signal in this thread.
void reset_signal(int number) {
    signal(number, SIG_DFL);
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, number);
    pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

/// Gives the locks up as late as possible, so that peers need not wait for a core dump: all other threads run until raise(),
/// and two hosts must not command the same motors. Any other thread waits until the first one ends the process.
[[noreturn]] void end_by_signal(int number) {
    pid_t nobody = 0;
    if (ending_thread.compare_exchange_strong(nobody, gettid())) give_up_locks();
    while (ending_thread != gettid()) pause();
    reset_signal(number);
    raise(number);
    _exit(128 + number);
}

/// Returns true for the first thread that reports. Any other thread waits until the first one ends the process. If
/// the same thread faults again, in the report itself, ends the process and writes the report as far as it exists.
bool begin_report(int number) {
    const pid_t self = gettid();
    pid_t nobody = 0;
    if (reporting_thread.compare_exchange_strong(nobody, self)) {
        reset_signal(SIGALRM); // limits the report's time: after a fault, nothing in the process is reliable
        alarm(max_report_seconds);
        return true;
    }
    while (reporting_thread != self) pause();
    report.write_to_stderr();
    end_by_signal(number);
}

void append_address(const siginfo_t& info, const ucontext_t& context) {
    const auto address = reinterpret_cast<std::uintptr_t>(info.si_addr);
    if (info.si_code <= 0) {
        // Sent by kill() or raise(), for example in abort(): there is no address.
        if (info.si_pid != getpid()) (report << ", sent by process ").decimal(info.si_pid);
        return;
    }
    switch (info.si_signo) {
    case SIGSEGV:
        if (info.si_code > 0 && is_stack_overflow(context, address))
            (report << ", the thread's stack has overflowed at address ").hexadecimal(address);
        else if (info.si_code == SEGV_MAPERR)
            (report << ", no memory at address ").hexadecimal(address);
        else if (info.si_code == SEGV_ACCERR)
            (report << ", access not permitted at address ").hexadecimal(address);
        else
            // outside the half of the address space that belongs to processes
            report << ", address not known";
        break;
    case SIGFPE:
        report << (info.si_code == FPE_INTDIV ? ", integer division by zero" : ", arithmetic error");
        break;
    default:
        (report << ", address ").hexadecimal(address);
    }
}

/// Appends, for example, "rtm_host: component Tank0 crashed in onExecute".
void append_callback(const std::optional<RunningCallback>& running) {
    report << program_name << ": ";
    if (!running)
        report << "crashed outside of the callbacks of components";
    else
        report << "component " << running->component << " crashed in " << running->name;
    if (running && running->port != nullptr) report << " of port " << running->port;
}

void append_function(const CodeLocation& location) {
    if (location.symbol[0] == '\0')
        report << "a function without a symbol";
    else
        report.symbol(location.symbol.data());
}

bool is_of_language_runtime(const CodeLocation& location) {
    const char* slash = std::strrchr(location.file.data(), '/');
    const std::string_view name = slash != nullptr ? slash + 1 : location.file.data();
    return name.starts_with("libc.so") || name.starts_with("libstdc++.so") || name.starts_with("libgcc_s.so");
}

/// Appends the innermost function outside libc and the C++ run time, which contain abort() and memcpy(). It is the
/// first function to examine.
void append_place(const StackTrace& trace) {
    for (std::size_t i = 0; i < trace.size; ++i) {
        const CodeLocation location = locate(trace.address[i]);
        if (location.file[0] == '\0') {
            (report << ", called address ").hexadecimal(trace.address[i]) << " without code";
        } else if (!is_of_language_runtime(location)) {
            report << ", in ";
            append_function(location);
            (report << " at ").hexadecimal(trace.address[i]) << " of " << location.file.data();
            return;
        }
    }
}

/// Appends the plugin and the thread.
void append_origin(const std::optional<RunningCallback>& running) {
    if (running && running->code != nullptr)
        report << "  plugin " << locate(reinterpret_cast<std::uintptr_t>(running->code)).file.data() << "\n";
    char thread[17] = "";
    prctl(PR_GET_NAME, thread);
    (report << "  thread ").decimal(gettid()) << " " << thread << "\n";
}

void append_calls(const StackTrace& trace) {
    for (std::size_t i = 0; i < trace.size; ++i) {
        const CodeLocation location = locate(trace.address[i]);
        (report << "  #").decimal(static_cast<std::int64_t>(i)) << (i < 10 ? "  " : " ");
        if (location.file[0] == '\0') {
            (report << "no code at ").hexadecimal(trace.address[i]);
        } else {
            append_function(location);
            (report << "  (" << location.file.data() << " +").hexadecimal(location.offset) << ")";
        }
        report << "\n";
    }
    if (trace.size == trace.address.size()) report << "  and calls further out\n";
}

/// Appends the end of the first line and the rest of the block, and writes the report.
void append_rest(const std::optional<RunningCallback>& running, const StackTrace& trace) {
    append_place(trace);
    report << "\n";
    append_origin(running);
    append_calls(trace);
    report.write_to_stderr();
}

void on_fault(int number, siginfo_t* info, void* context) {
    if (begin_report(number)) {
        const std::optional<RunningCallback> running = running_callback();
        append_callback(running);
        (report << ": signal ").decimal(number) << " (" << sigdescr_np(number) << ")";
        auto& interrupted = *static_cast<ucontext_t*>(context);
        append_address(*info, interrupted);
        append_rest(running, interrupted_calls(interrupted));
    }
    end_by_signal(number);
}

void append_exception() {
    const std::type_info* type = abi::__cxa_current_exception_type();
    if (type == nullptr) {
        report << "std::terminate() was called, for example because a std::thread was destroyed that had not "
                  "been "
                  "joined";
        return;
    }
    (report << "an uncaught exception of type ").type(type->name());
    try {
        throw;
    } catch (const std::exception& error) {
        report << ": " << error.what();
    } catch (...) { // other types have no text
    }
}

[[noreturn]] void on_terminate() {
    if (begin_report(SIGABRT)) {
        const std::optional<RunningCallback> running = running_callback();
        append_callback(running);
        report << ": ";
        append_exception();
        append_rest(running, calls_from(reinterpret_cast<std::uintptr_t>(__builtin_return_address(0))));
    }
    end_by_signal(SIGABRT);
}

/// For signals whose default action writes a core dump, but which are not caused by the code that they interrupt.
void on_core_dump(int number) { end_by_signal(number); }

void handle_core_dumps() {
    struct sigaction action {};
    action.sa_handler = on_core_dump;
    action.sa_flags = SA_ONSTACK;
    sigemptyset(&action.sa_mask);
    for (const int number : {SIGQUIT, SIGTRAP, SIGSYS, SIGXCPU}) {
        struct sigaction present {};
        // A shell starts programs in the background with SIGQUIT ignored.
        if (sigaction(number, nullptr, &present) == 0 && present.sa_handler == SIG_DFL)
            sigaction(number, &action, nullptr);
    }
}

} // namespace

void install_crash_report(const char* program) {
    program_name = program;
    enable_alternate_stacks();
    give_this_thread_an_alternate_stack();
    struct sigaction action {};
    action.sa_sigaction = on_fault;
    // SA_NODEFER: a second fault, in the handler, also calls the handler. Otherwise it would end the process without
    // a report.
    action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER;
    sigemptyset(&action.sa_mask);
    for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) sigaction(number, &action, nullptr);
    handle_core_dumps();
    std::set_terminate(on_terminate);
}

} // namespace tandem::crash
