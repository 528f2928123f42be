// SPDX-License-Identifier: Apache-2.0
// Which thread a shared tick belongs to.
#include "host/process/start_thread.hpp"
#include "host/rt/periodic_tick.hpp"
#include "host/rt/tick_thread.hpp"

#include <algorithm>
#include <chrono>
#include <tuple>
#include <utility>

namespace tandem::rt {
namespace {

// Number of members of a thread at which a second thread for equal options starts.
constexpr std::size_t full_thread = 32;
constexpr std::chrono::milliseconds watch_interval{10};

std::string in_ms(std::int64_t ns) { return std::to_string((ns + 500'000) / 1'000'000) + " ms"; }

} // namespace

bool are_equal(const SharedTickOptions& a, const SharedTickOptions& b) {
    const auto parts = [](const SharedTickOptions& each) {
        return std::tuple(each.period, each.phase, each.thread.fifo_priority, each.thread.cpu,
                          each.thread.round_robin);
    };
    return parts(a) == parts(b);
}

TickThreads& TickThreads::all() {
    static auto* const threads = new TickThreads;
    return *threads;
}

// The number of members changes only with the mutex held.
std::shared_ptr<TickThread> TickThreads::find_thread(const SharedTickOptions& options) const {
    std::shared_ptr<TickThread> smallest;
    unsigned count = 0;
    for (const auto& each : threads_) {
        if (!are_equal(each->options, options)) continue;
        ++count;
        if (!smallest || each->members.size() < smallest->members.size()) smallest = each;
    }
    const bool may_start = options.thread.cpu < 0 && count < std::thread::hardware_concurrency();
    return smallest && smallest->members.size() >= full_thread && may_start ? nullptr : smallest;
}

void TickThreads::add(const std::shared_ptr<SharedTick>& tick, const SharedTickOptions& options) {
    if (const auto found = find_thread(options)) {
        const TickThread::Lock lock(found->mutex);
        found->add(tick);
    } else {
        const auto thread = std::make_shared<TickThread>(options);
        thread->add(tick);
        thread->start();
        threads_.push_back(thread);
    }
}

void TickThreads::remove(const SharedTick& tick, const std::shared_ptr<TickThread>& thread) {
    thread->remove(tick);
    if (thread->members.empty()) std::erase(threads_, thread);
}

void TickThreads::apply_change(const std::shared_ptr<SharedTick>& tick) {
    const auto former = tick->thread_;
    {
        const TickThread::Lock lock(former->mutex);
        if (former->running == tick.get()) return; // run_cycle() calls this again
        const auto options = std::exchange(tick->next_options_, std::nullopt);
        if (!options || tick->left_ || are_equal(former->options, *options)) return;
        try {
            add(tick, *options);
        } catch (const process::NotStarted& error) {
            tick->thread_ = former;
            tick->work_.log(tick->work_.name + " keeps its previous period: " + error.what());
            return;
        }
        remove(*tick, former);
    }
    ensure_watch(); // takes the mutex of each thread
}

void TickThreads::separate(const std::shared_ptr<SharedTick>& tick, std::int64_t took) {
    const auto former = tick->thread_;
    {
        const TickThread::Lock lock(former->mutex);
        // Another thread may have moved it meanwhile.
        if (tick->left_ || former->running == tick.get() || former->members.size() < 2) return;
        const auto separate = std::make_shared<TickThread>(former->options);
        separate->add(tick);
        try {
            separate->start();
        } catch (const process::NotStarted&) {
            tick->thread_ = former; // it delays the others as before
            return;
        }
        remove(*tick, former);
    }
    tick->work_.log(tick->work_.name + " has a separate thread: its cycle took " + in_ms(took) +
                    ", in which the other components of its thread waited");
}

void TickThreads::ensure_watch() {
    if (!is_watched_ && has_work_to_watch()) is_watched_ = process::start_detached([this] { watch(); });
}

bool TickThreads::has_work_to_watch() const {
    return std::any_of(threads_.begin(), threads_.end(), [](const auto& each) {
        const TickThread::Lock lock(each->mutex);
        return each->delays_members() && (each->has_woken || !each->rests());
    });
}

void TickThreads::watch() {
    TickThread::Lock lock(mutex);
    while (has_work_to_watch()) {
        lock.unlock();
        std::this_thread::sleep_for(watch_interval);
        lock.lock();
        for (auto& each : threads_) rescue_neighbours(each);
    }
    is_watched_ = false;
}

/// Leaves a thread whose cycle hangs to that cycle and gives the other members a new one.
void TickThreads::rescue_neighbours(std::shared_ptr<TickThread>& thread) {
    const auto hanging = thread;
    std::shared_ptr<SharedTick> tick;
    {
        const TickThread::Lock lock(hanging->mutex);
        if (!hanging->hangs(monotonic_ns())) return;
        const auto others = std::make_shared<TickThread>(hanging->options);
        others->has_woken = true; // the round of the hanging cycle has not reached all members
        std::vector<std::shared_ptr<SharedTick>> kept;
        for (const auto& each : hanging->members)
            (each.get() == hanging->running ? kept : others->members).push_back(each);
        try {
            others->start();
        } catch (const process::NotStarted&) {
            return; // they wait for the end of the cycle
        }
        for (const auto& each : others->members) each->thread_ = others;
        hanging->members = std::move(kept);
        hanging->next = hanging->members.size();
        thread = others;
        if (hanging->members.empty()) return; // it has left
        tick = hanging->members.front();
    }
    tick->work_.log(tick->work_.name +
                    " keeps its thread: its cycle has not returned, and the other components of " +
                    "its thread have another one");
}

} // namespace tandem::rt
