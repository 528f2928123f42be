// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/path/tracer.hpp"

#include "apps/bench/machine/cores.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sched.h>
#include <stdexcept>
#include <sys/ptrace.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <system_error>

namespace tandem::bench {

namespace {

constexpr unsigned char int3 = 0xcc;

/// An address at which nothing is mapped (vm.mmap_min_addr): a thread that returns there gets SIGSEGV.
constexpr std::uint64_t nowhere = 0x10;

/// Throws std::runtime_error. ptrace() fails only if it is not permitted, or if the process has been killed.
void trace(__ptrace_request request, pid_t thread, std::uintptr_t data) {
    auto* const pointer = reinterpret_cast<void*>(data); // NOLINT(performance-no-int-to-ptr)
    if (ptrace(request, thread, nullptr, pointer) != 0)
        throw std::runtime_error(fmt::format("ptrace of thread {} failed: {}", thread, std::strerror(errno)));
}

std::set<pid_t> threads_of(pid_t process) {
    std::set<pid_t> found;
    std::error_code gone; // a thread may end between listing and reading
    for (const auto& entry : std::filesystem::directory_iterator(fmt::format("/proc/{}/task", process), gone))
        found.insert(std::stoi(entry.path().filename().string()));
    return found;
}

/// Returns whether a thread neither runs nor is about to run: proc(5), the third field of stat. A thread that
/// has ended counts as asleep.
bool thread_is_asleep(pid_t thread) {
    std::ifstream file(fmt::format("/proc/{0}/task/{0}/stat", thread));
    std::string text;
    if (!std::getline(file, text)) return true;
    const auto name_end = text.rfind(')');
    if (name_end == std::string::npos || name_end + 2 >= text.size()) return true;
    const char state = text[name_end + 2];
    return state != 'R' && state != 'D';
}

} // namespace

std::size_t read_memory(pid_t process, std::uint64_t address, void* buffer, std::size_t bytes) {
    auto* const there = reinterpret_cast<void*>(address); // NOLINT(performance-no-int-to-ptr)
    const iovec local{buffer, bytes}, remote{there, bytes};
    const ssize_t got = process_vm_readv(process, &local, 1, &remote, 1, 0);
    return got < 0 ? 0 : static_cast<std::size_t>(got);
}

Tracer::Tracer() : core_(sched_getcpu()) { pin_to(core_); }

// Each traced thread must be reaped by its tracer. Until then, its process has not ended for any other
// process.
Tracer::~Tracer() {
    for (const pid_t process : processes_) kill(process, SIGKILL);
    while (!threads_.empty()) {
        int status = 0;
        const pid_t thread = waitpid(-1, &status, __WALL);
        if (thread < 0 && errno != EINTR) return;
        if (thread > 0 && !WIFSTOPPED(status)) threads_.erase(thread);
    }
}

void Tracer::attach_thread(pid_t thread) {
    if (threads_.contains(thread)) return;
    if (ptrace(PTRACE_SEIZE, thread, nullptr, PTRACE_O_TRACECLONE | PTRACE_O_EXITKILL) != 0) {
        // A thread that was started after the first one was attached is already traced.
        if (!threads_.empty() && (errno == EPERM || errno == ESRCH)) return;
        throw std::runtime_error(fmt::format("ptrace is not permitted here ({}); see "
                                             "kernel.yama.ptrace_scope and the container's seccomp profile",
                                             std::strerror(errno)));
    }
    threads_[thread] = {};
    pin_thread_to(thread, core_); // a thread that is not pinned is also stepped, only more slowly
}

void Tracer::attach(pid_t process) {
    attach_thread(process);
    processes_.insert(process);
    for (const pid_t thread : threads_of(process)) attach_thread(thread);
}

void Tracer::wait_for_event() {
    int status = 0;
    const pid_t thread = waitpid(-1, &status, __WALL);
    if (thread < 0) {
        if (errno == EINTR) return;
        throw std::system_error(errno, std::generic_category(), "waiting for a traced process");
    }
    handle(thread, status);
}

void Tracer::handle(pid_t thread, int status) {
    if (WIFSTOPPED(status)) return handle_stop(thread, status);
    threads_.erase(thread);
    if (processes_.contains(thread))
        throw std::runtime_error(
            WIFSIGNALED(status) ? fmt::format("a traced process was ended by signal {}", WTERMSIG(status))
                                : fmt::format("a traced process exited with {}", WEXITSTATUS(status)));
}

/// ptrace(2): the third byte of the status contains an event. A stop without an event is the arrival of a
/// signal.
void Tracer::handle_stop(pid_t thread, int status) {
    Thread& state = threads_[thread]; // the first stop of a new thread may come before its creator's event
    const int event = status >> 16, signal = WSTOPSIG(status);
    if (event == PTRACE_EVENT_STOP && state.interrupted) {
        state.interrupted = false;
        state.state = State::still;
        state.mark = PathMark::none;
        return;
    }
    if (event != 0) return continue_with(thread, 0);
    if (signal == SIGTRAP) return handle_trap(thread);
    if (signal == SIGSEGV && state.state == State::returning) return handle_return(thread);
    continue_with(thread, signal);
}

void Tracer::handle_trap(pid_t thread) {
    Thread& state = threads_.at(thread);
    if (is_stepped(thread)) {
        state.state = State::still;
        state.mark = PathMark::none;
        return;
    }
    const user_regs_struct now = registers(thread);
    unsigned char before = 0;
    read_memory(thread, now.rip - 1, &before, 1);
    const auto place = static_cast<PathMark>(now.rdi);
    if (before != int3) return continue_with(thread, SIGTRAP); // not a mark, but the process's own trap
    if (ignored_.contains(place)) return continue_with(thread, 0);
    state.state = State::still;
    state.mark = place;
}

void Tracer::continue_with(pid_t thread, int signal) {
    const bool steps = threads_.at(thread).state == State::stepping;
    trace(steps ? PTRACE_SINGLESTEP : PTRACE_CONT, thread, static_cast<std::uintptr_t>(signal));
}

pid_t Tracer::wait_at(PathMark mark) {
    for (;;) {
        for (const auto& [id, thread] : threads_)
            if (thread.state == State::still && thread.mark == mark) return id;
        wait_for_event();
    }
}

PathMark Tracer::wait_for(pid_t thread) {
    while (!stands_still(thread)) wait_for_event();
    return mark_of(thread);
}

pid_t Tracer::wait_for_any() {
    for (;;) {
        for (const auto& [id, thread] : threads_)
            if (thread.state == State::still) return id;
        wait_for_event();
    }
}

void Tracer::resume(pid_t thread) {
    threads_.at(thread) = {};
    continue_with(thread, 0);
}

void Tracer::begin_step(pid_t thread) {
    Thread& state = threads_.at(thread);
    user_regs_struct now = registers(thread);
    unsigned char next = 0;
    read_memory(thread, now.rip, &next, 1);
    if (next == int3) { // skipped here, so that a step never ends in the trap of a mark
        state.mark = static_cast<PathMark>(now.rdi);
        ++now.rip;
        trace(PTRACE_SETREGS, thread, reinterpret_cast<std::uintptr_t>(&now));
        return;
    }
    state.state = State::stepping;
    continue_with(thread, 0);
}

/// The thread returns to an unmapped address. A breakpoint in the code would also stop the other threads, and
/// one in a debug register does not work in some virtual machines.
void Tracer::begin_return(pid_t thread) {
    const std::uint64_t stack = registers(thread).rsp;
    Thread& state = threads_.at(thread);
    read_memory(thread, stack, &state.return_address, sizeof state.return_address);
    auto* const top = reinterpret_cast<void*>(stack); // NOLINT(performance-no-int-to-ptr)
    if (ptrace(PTRACE_POKEDATA, thread, top, nowhere) != 0)
        throw std::runtime_error(
            fmt::format("cannot write the stack of thread {}: {}", thread, std::strerror(errno)));
    state.state = State::returning;
    continue_with(thread, 0);
}

void Tracer::handle_return(pid_t thread) {
    user_regs_struct now = registers(thread);
    if (now.rip != nowhere) return continue_with(thread, SIGSEGV); // the process's own signal
    Thread& state = threads_.at(thread);
    now.rip = state.return_address;
    trace(PTRACE_SETREGS, thread, reinterpret_cast<std::uintptr_t>(&now));
    state.state = State::still;
    state.mark = PathMark::none;
}

user_regs_struct Tracer::registers(pid_t thread) const {
    user_regs_struct now{};
    trace(PTRACE_GETREGS, thread, reinterpret_cast<std::uintptr_t>(&now));
    return now;
}

void Tracer::interrupt(pid_t thread) {
    threads_.at(thread).interrupted = true;
    trace(PTRACE_INTERRUPT, thread, 0);
    wait_for(thread);
}

void Tracer::freeze_others(pid_t thread, const std::set<pid_t>& exceptions) {
    for (const pid_t other : threads_of(thread)) {
        const auto found = threads_.find(other);
        if (other == thread || exceptions.contains(other) || found == threads_.end() || stands_still(other))
            continue;
        wait_until_asleep({other});
        interrupt(other);
        // The thread is not in a system call: it has just woken up, and continues until it sleeps again.
        while (static_cast<std::int64_t>(registers(other).orig_rax) < 0) {
            resume(other);
            wait_until_asleep({other});
            interrupt(other);
        }
        found->second.state = State::frozen;
    }
}

void Tracer::thaw() {
    for (const auto& [thread, state] : threads_)
        if (state.state == State::frozen) resume(thread);
}

void Tracer::wait_until_asleep(const std::set<pid_t>& threads) {
    for (;;) {
        const bool asleep = std::all_of(threads.begin(), threads.end(), thread_is_asleep);
        // A thread that is stopped at an ignored mark must be continued; it is not asleep then.
        int status = 0;
        const pid_t changed = waitpid(-1, &status, __WALL | WNOHANG);
        if (changed > 0)
            handle(changed, status);
        else if (asleep)
            return;
        else
            sched_yield();
    }
}

} // namespace tandem::bench
