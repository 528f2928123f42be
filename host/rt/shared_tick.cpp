// SPDX-License-Identifier: Apache-2.0
#include "host/rt/shared_tick.hpp"

#include "host/process/start_thread.hpp"
#include "host/rt/tick_thread.hpp"

#include <atomic>

namespace tandem::rt {

std::shared_ptr<SharedTick> SharedTick::start(const SharedTickOptions& options, Work work, Next first) {
    auto tick = std::make_shared<SharedTick>(std::move(work));
    tick->rests_ = first == Next::rest;
    TickThreads& threads = TickThreads::all();
    const TickThread::Lock all(threads.mutex);
    try {
        threads.add(tick, options);
    } catch (const process::NotStarted&) {
        tick->thread_.reset(); // has the tick as its member
        throw;
    }
    threads.ensure_watch();
    return tick;
}

void SharedTick::wake() {
    TickThreads& threads = TickThreads::all();
    const TickThread::Lock all(threads.mutex);
    {
        const TickThread::Lock lock(thread_->mutex);
        woken_ = true;
        if (!rests_ || left_) return;
        thread_->has_woken = true;
        thread_->changed.notify_all();
    }
    threads.ensure_watch();
}

void SharedTick::change(const SharedTickOptions& options) {
    TickThreads& threads = TickThreads::all();
    const TickThread::Lock all(threads.mutex);
    {
        const TickThread::Lock lock(thread_->mutex);
        next_options_ = options;
    }
    threads.apply_change(shared_from_this());
}

bool SharedTick::leave(std::chrono::nanoseconds timeout) {
    TickThreads& threads = TickThreads::all();
    TickThread::Lock all(threads.mutex);
    const auto thread = thread_;
    TickThread::Lock lock(thread->mutex);
    if (!left_) threads.remove(*this, thread);
    left_ = true;
    all.unlock();
    const bool is_inside = thread->id == std::this_thread::get_id();
    if (is_inside) return true;
    if (!thread->changed.wait_for(lock, timeout, [&] { return thread->running != this; })) return false;
    // Another tick that has left may still be in its cycle, and may hang. Its thread then ends without being awaited.
    if (!thread->members.empty() || thread->running != nullptr || !thread->thread.joinable()) return true;
    std::thread ending = std::move(thread->thread);
    lock.unlock();
    ending.join();
    return true;
}

std::shared_ptr<void> take_separate_tick_thread() {
    constexpr int most = 16;
    static std::atomic<int> taken{0};
    if (taken.fetch_add(1) < most) return {&taken, [](std::atomic<int>* count) { --*count; }};
    --taken;
    return nullptr;
}

} // namespace tandem::rt
