// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/path/path_recorder.hpp"

#include <fmt/format.h>
#include <stdexcept>

namespace tandem::bench {

namespace {

/// The mark of success of an operation.
PathMark end_of(PathMark begin) {
    if (begin == PathMark::send_begin) return PathMark::send_end;
    return begin == PathMark::receive_begin ? PathMark::receive_end : PathMark::call_end;
}

void require_end(PathMark reached, PathMark begin) {
    if (reached != end_of(begin))
        throw std::runtime_error(fmt::format("the traced operation has failed: mark {} instead of {}; the "
                                             "link broke off, or a message was lost",
                                             static_cast<int>(reached), static_cast<int>(end_of(begin))));
}

} // namespace

PathTrace PathRecorder::best_of(const std::function<PathTrace()>& attempt) const {
    PathTrace best = attempt();
    for (int i = 1; i < attempts; ++i) {
        PathTrace again = attempt();
        if (again.counts().instructions < best.counts().instructions) best = std::move(again);
    }
    return best;
}

/// Lets a thread perform its operation at full speed. Returns true if it succeeded.
bool PathRecorder::pass(PathMark begin, PathMark end) {
    const pid_t thread = tracer_.wait_at(begin);
    tracer_.resume(thread);
    const bool succeeded = tracer_.wait_for(thread) == end;
    tracer_.resume(thread);
    return succeeded;
}

void PathRecorder::warm_up_data() {
    for (int received = 0; received < warm_up_rounds;) { // nothing arrives until the link is up
        pass(PathMark::send_begin, PathMark::send_end);
        if (pass(PathMark::receive_begin, PathMark::receive_end)) ++received;
    }
}

/// Executes the next instruction, or a whole function of the vdso, because instructions that do not count
/// need no stepping.
void PathRecorder::begin_step(pid_t thread, const user_regs_struct& registers, const PathTrace& trace) {
    if (trace.is_of_kernel(registers.rip))
        tracer_.begin_return(thread);
    else
        tracer_.begin_step(thread);
}

/// Steps the thread that is stopped at `begin` until its operation has ended, and then continues it.
PathTrace PathRecorder::step_to_end(PathMark begin, const std::function<void()>& after_each_step) {
    const pid_t thread = tracer_.wait_at(begin);
    PathTrace trace(thread);
    tracer_.freeze_others(thread, workers_);
    for (;;) {
        const user_regs_struct registers = tracer_.registers(thread);
        begin_step(thread, registers, trace);
        const PathMark reached = tracer_.wait_for(thread);
        if (reached == PathMark::none) {
            trace.add(registers);
            after_each_step();
        } else if (reached != PathMark::served) { // which a local call passes
            tracer_.thaw();
            tracer_.resume(thread);
            require_end(reached, begin);
            return trace;
        }
    }
}

PathTrace PathRecorder::record_sender() {
    warm_up_data();
    return best_of([this] {
        PathTrace trace = step_to_end(PathMark::send_begin, [] {});
        pass(PathMark::receive_begin, PathMark::receive_end);
        return trace;
    });
}

PathTrace PathRecorder::record_receiver() {
    warm_up_data();
    return best_of([this] {
        pass(PathMark::send_begin, PathMark::send_end);
        return step_to_end(PathMark::receive_begin, [] {});
    });
}

/// Makes one call at full speed and remembers which thread served it. Returns true if it succeeded.
bool PathRecorder::run_one_call() {
    const pid_t caller = tracer_.wait_at(PathMark::call_begin);
    tracer_.resume(caller);
    for (;;) {
        const pid_t thread = tracer_.wait_for_any();
        const PathMark reached = tracer_.mark_of(thread);
        tracer_.resume(thread);
        if (reached == PathMark::served) workers_.insert(thread);
        if (thread == caller && reached != PathMark::served) return reached == PathMark::call_end;
    }
}

void PathRecorder::warm_up_calls() {
    for (int answered = 0; answered < warm_up_rounds;)
        if (run_one_call()) ++answered;
}

PathTrace PathRecorder::record_local_call() {
    warm_up_calls();
    return best_of([this] { return step_to_end(PathMark::call_begin, [] {}); });
}

PathTrace PathRecorder::record_caller() {
    warm_up_calls();
    tracer_.ignore(PathMark::served);
    return best_of([this] {
        tracer_.wait_at(PathMark::call_begin);
        tracer_.wait_until_asleep(workers_); // the call must wake one
        return step_to_end(PathMark::call_begin, [this] { tracer_.wait_until_asleep(workers_); });
    });
}

PathTrace PathRecorder::record_worker() {
    return best_of([this] {
        // Each time, because a slow worker, like one that is stepped, makes the link start another one, which
        // takes its turn from then on.
        warm_up_calls();
        return step_worker(tracer_.wait_at(PathMark::call_begin));
    });
}

PathTrace PathRecorder::step_worker(pid_t caller) {
    tracer_.wait_until_asleep(workers_);
    // Any of them may be woken. Each sleeps in the system call that is stepped.
    std::map<pid_t, PathTrace> traces;
    for (const pid_t worker : workers_) {
        traces.try_emplace(worker, worker);
        if (tracer_.is_stepped(worker))
            continue; // it is stepped since an earlier attempt, in which it was not woken
        tracer_.interrupt(worker);
        tracer_.begin_step(worker);
    }
    tracer_.freeze_others(*workers_.begin(), workers_);
    tracer_.resume(caller);
    pid_t server_thread = 0;
    while (!tracer_.stands_still(caller)) {
        const pid_t thread = tracer_.wait_for_any();
        if (thread == caller) break;
        const PathMark reached = tracer_.mark_of(thread);
        if (reached == PathMark::served) server_thread = thread;
        // The caller may find its reply now; the worker would execute its next instruction after the call.
        tracer_.wait_until_asleep({caller});
        if (tracer_.stands_still(caller)) break;
        const user_regs_struct registers = tracer_.registers(thread);
        begin_step(thread, registers, traces.at(thread));
        // A thread that is stopped at a mark after begin_step() has executed nothing.
        if (!tracer_.stands_still(thread)) traces.at(thread).add(registers);
    }
    const PathMark reached = tracer_.mark_of(caller);
    tracer_.thaw();
    for (const pid_t worker : workers_) {
        // A worker that has not been woken continues to sleep, perhaps forever. Its step ends with the call
        // that wakes it.
        if (tracer_.stands_still(worker)) tracer_.resume(worker);
    }
    tracer_.resume(caller);
    require_end(reached, PathMark::call_begin);
    if (server_thread == 0)
        throw std::runtime_error("the call was served by a thread that had served none before");
    return std::move(traces.at(server_thread));
}

} // namespace tandem::bench
