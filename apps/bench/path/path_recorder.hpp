// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/path/path_trace.hpp"
#include "apps/bench/path/tracer.hpp"

#include <functional>

namespace tandem::bench {

/// Steps one side of a warm path and records its instructions. The smallest of several results counts: a
/// disturbance of the stepped thread, for instance by a timer that has expired, only adds instructions. All
/// functions return the trace, or throw std::runtime_error if the operation fails.
class PathRecorder {
  public:
    explicit PathRecorder(Tracer& tracer) : tracer_(tracer) {}

    /// Record the two ends of a message. One thread sends, and another or the same one receives. The message has
    /// arrived before the receiver checks for it.
    PathTrace record_sender();
    PathTrace record_receiver();
    /// Records a call that is served in the caller's own thread.
    PathTrace record_local_call();
    /// Records a call to another process. Between two steps of the caller, the peer's worker gets all the time that
    /// it needs, so the caller finds its reply at the first check.
    PathTrace record_caller();
    /// Records the peer's worker, from its wake-up until the caller has its reply.
    PathTrace record_worker();

  private:
    static constexpr int warm_up_rounds = 50, attempts = 10;

    PathTrace best_of(const std::function<PathTrace()>& attempt) const;
    PathTrace step_to_end(PathMark begin, const std::function<void()>& after_each_step);
    PathTrace step_worker(pid_t caller);
    void begin_step(pid_t thread, const user_regs_struct& registers, const PathTrace& trace);
    bool pass(PathMark begin, PathMark end);
    void warm_up_data();
    void warm_up_calls();
    bool run_one_call();

    Tracer& tracer_;
    std::set<pid_t> workers_; // threads that have served calls
};

} // namespace tandem::bench
