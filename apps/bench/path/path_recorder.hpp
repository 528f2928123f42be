// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/bench/path/path_trace.hpp"
#include "apps/bench/path/tracer.hpp"

#include <functional>

namespace tandem::bench {

/// Steps one side of a warm road and records its instructions. The best of several times counts: whatever disturbs a
/// thread that is stepped only adds instructions, for instance a timer that has run out meanwhile. All functions throw
/// std::runtime_error if the operation fails, and otherwise the trace.
class PathRecorder {
  public:
    explicit PathRecorder(Tracer& tracer) : tracer_(tracer) {}

    /// Data: one thread sends, the other one (or the same) receives. The message is there when the receiver looks.
    PathTrace record_sender();
    PathTrace record_receiver();
    /// A call that is served in the caller's own thread.
    PathTrace record_local_call();
    /// A call across: between two steps of the caller the peer's worker gets all the time that it needs, so that the
    /// caller finds its reply when it looks first.
    PathTrace record_caller();
    /// The peer's worker, from its wake to where the caller has its reply.
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
