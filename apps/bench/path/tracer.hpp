// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/path/path_mark.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <sys/types.h>
#include <sys/user.h>

namespace tandem::bench {

/// [one thread] Stops and steps the threads of other processes by ptrace(2). No wait here has a timeout: the
/// driver kills a case that takes too long, and the kernel then kills the traced processes.
class Tracer {
  public:
    Tracer();  ///< pins the calling thread to its current core
    ~Tracer(); ///< kills the traced processes and reaps them
    Tracer(const Tracer&) = delete;
    Tracer& operator=(const Tracer&) = delete;

    /// Traces all threads of a child process, and those that they start, and pins them to the tracer's core.
    /// Each step wakes the stepped thread and then the tracer, which takes up to 0.4 ms on a virtual machine
    /// if they are on two cores. Throws std::runtime_error, in one line, if tracing is not permitted.
    void attach(pid_t process);

    /// From here on, threads pass this mark without stopping.
    void ignore(PathMark mark) { ignored_.insert(mark); }
    /// Waits until a thread is stopped at the mark, and returns it. Throws std::runtime_error if a traced
    /// process ends.
    pid_t wait_at(PathMark mark);
    /// Waits until a thread that was continued or stepped stands still. Returns its mark, or none.
    PathMark wait_for(pid_t thread);
    /// Waits for the next thread that stands still, and returns it.
    pid_t wait_for_any();

    /// [of a thread that stands still]
    void resume(pid_t thread);
    /// Executes the next instruction. If that is a mark, the thread stops at it at once. wait_for() returns
    /// when the step is complete.
    void begin_step(pid_t thread);
    /// Executes the function at whose first instruction the thread stands, at full speed; wait_for() returns
    /// when the function has returned. For code that starts again when it is too slow, as the vdso's clock
    /// does if a tick comes meanwhile.
    void begin_return(pid_t thread);
    user_regs_struct registers(pid_t thread) const;
    PathMark mark_of(pid_t thread) const { return threads_.at(thread).mark; }
    bool stands_still(pid_t thread) const { return threads_.at(thread).state == State::still; }
    /// Returns whether its step, by begin_step() or begin_return(), is incomplete.
    bool is_stepped(pid_t thread) const {
        const State state = threads_.at(thread).state;
        return state == State::stepping || state == State::returning;
    }

    /// Stops a thread that runs or sleeps in the kernel. An interrupted system call is restarted.
    void interrupt(pid_t thread);
    /// Stops the other threads of its process, except `exceptions`, while they sleep in the kernel, so that
    /// none holds a lock. A stepped thread would meet them at locks, which never happens at full speed.
    void freeze_others(pid_t thread, const std::set<pid_t>& exceptions);
    /// Continues all threads that were frozen.
    void thaw();
    /// Waits until each of these threads sleeps in the kernel or stands still.
    void wait_until_asleep(const std::set<pid_t>& threads);

  private:
    enum class State { running, stepping, returning, still, frozen };
    struct Thread {
        State state = State::running;
        PathMark mark = PathMark::none;
        bool interrupted = false; // interrupt() waits for the stop of this thread
        std::uint64_t return_address = 0;
    };

    void attach_thread(pid_t thread);
    void handle(pid_t thread, int status);
    void handle_stop(pid_t thread, int status);
    void handle_trap(pid_t thread);
    void handle_return(pid_t thread);
    void continue_with(pid_t thread, int signal);
    void wait_for_event();

    int core_;
    std::set<pid_t> processes_;
    std::set<PathMark> ignored_;
    std::map<pid_t, Thread> threads_;
};

/// Copies up to `bytes` bytes of a traced process's memory. Returns how many could be read.
std::size_t read_memory(pid_t process, std::uint64_t address, void* buffer, std::size_t bytes);

} // namespace tandem::bench
