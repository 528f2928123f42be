// SPDX-License-Identifier: Apache-2.0
// The threads of shared ticks. Internal to this room.
#pragma once

#include "host/rt/shared_tick.hpp"

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace tandem::rt {

/// A thread that runs the cycles of its members, until none is left. To move a member, lock the mutex of
/// TickThreads and then that of the thread.
struct TickThread : std::enable_shared_from_this<TickThread> {
    using Lock = std::unique_lock<std::mutex>;

    explicit TickThread(SharedTickOptions of_all) : options(std::move(of_all)) {}
    /// Starts the thread. Throws process::NotStarted.
    void start();
    bool rests() const;
    /// Returns whether a member may wait for the cycle of another one, or of one that has left.
    bool delays_members() const;
    void add(const std::shared_ptr<SharedTick>& tick);
    void remove(const SharedTick& tick);
    /// Returns true if two calls in a row find the same cycle running, and it delays others for too long. `now`: in ns.
    bool hangs(std::int64_t now);

    const SharedTickOptions options;
    std::mutex mutex;
    std::condition_variable changed;
    std::vector<std::shared_ptr<SharedTick>> members;
    std::size_t next = 0;          // the member whose turn is next in the current round
    SharedTick* running = nullptr; // the member whose cycle runs
    std::int64_t running_since = 0, looked_at = 0;
    bool has_woken = false; // a resting member must run at once
    std::thread thread;     // none if leave() joins it
    std::thread::id id;

  private:
    void run();
    void run_round(Lock& lock, bool all);
    void run_cycle(Lock& lock, const std::shared_ptr<SharedTick>& tick, std::int64_t& now);
    void prefetch_following() const;
    void note_lines(SharedTick& tick);
    bool takes_too_long(SharedTick& tick, std::int64_t took);
    void plan_next();

    std::int64_t planned = 0;
    std::size_t rounds = 0;
    long waits = 0; // voluntary context switches of the thread at the last look
};

/// All threads of shared ticks in the process.
class TickThreads {
  public:
    /// Never deleted: a thread that hangs in a cycle may outlive static objects.
    static TickThreads& all();

    // The next five require the mutex.

    /// Adds the tick to a thread with these options. Throws process::NotStarted.
    void add(const std::shared_ptr<SharedTick>& tick, const SharedTickOptions& options);
    /// Ends the tick's membership in the thread, whose mutex the caller holds.
    void remove(const SharedTick& tick, const std::shared_ptr<TickThread>& thread);
    /// Looks for cycles that hang, as long as threads may delay members that do not rest.
    void ensure_watch();
    /// Moves the tick to a thread with its next options, if it has any. While its cycle runs, this waits for the cycle's end.
    void apply_change(const std::shared_ptr<SharedTick>& tick);
    /// Gives the tick a thread that no other tick joins, unless it has left or no thread can be started.
    void separate(const std::shared_ptr<SharedTick>& tick, std::int64_t took);

    std::mutex mutex;

  private:
    void watch();
    bool has_work_to_watch() const;
    void rescue_neighbours(std::shared_ptr<TickThread>& thread);
    std::shared_ptr<TickThread> find_thread(const SharedTickOptions& options) const;

    std::vector<std::shared_ptr<TickThread>> threads_; // those that ticks may join
    bool is_watched_ = false;
};

} // namespace tandem::rt
