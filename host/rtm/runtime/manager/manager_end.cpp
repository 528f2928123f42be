// SPDX-License-Identifier: Apache-2.0
// Who ends the manager. OpenRTM-aist's shutdown() ends it in the calling thread, which waits for itself if it is in a
// component's callback. Here such a caller only requests the end; manager_shutdown.cpp has the steps.
#include "host/crash/callback_scope.hpp"
#include "host/process/start_thread.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include <cstdlib>

namespace RTC {

// A thread that a component has created must not wait either, because the component's destructor may join it.
bool Manager::shutdown() {
    bool is_requested = false, has_main_loop = false;
    {
        std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
        has_main_loop = m_impl->main_loop != std::thread::id();
        is_requested =
            m_impl->must_return_first() || (m_impl->is_run && m_impl->owner != std::this_thread::get_id());
    }
    if (is_requested) {
        m_impl->request_end(*this);
        return true;
    }
    if (has_main_loop) terminate();
    return m_impl->end(*this);
}

bool end_during_set_up(Manager& manager) { return manager.impl().end(manager); }

// The context of a component needs the thread of a callback, the ORB that of a service call, the main loop that of a
// task.
bool Manager::Impl::must_return_first() const {
    const auto caller = std::this_thread::get_id();
    return tandem::crash::running_callback().has_value() || caller == main_loop || caller == ending;
}

void Manager::Impl::request_end(Manager& manager) {
    bool others_end_it = false;
    {
        std::lock_guard<std::recursive_mutex> lock(mutex);
        others_end_it = main_loop != std::thread::id() || shut_down || end_requested;
        end_requested = end_requested || !others_end_it;
    }
    if (!others_end_it) wait_for_end_at_exit(); // before main() can notice the request
    terminate();
    if (others_end_it) return;
    try {
        tandem::process::start_thread([this, &manager] {
            {
                std::unique_lock<std::recursive_mutex> lock(mutex);
                end_changed.wait(lock, [this] { return !setting_up; });
                if (main_loop != std::thread::id()) return; // it has begun meanwhile, and ends the manager
            }
            end(manager);
        }).detach();
    } catch (const tandem::process::NotStarted& e) {
        {
            std::lock_guard<std::recursive_mutex> lock(mutex);
            end_requested = false; // shutdown() may try again
        }
        Logger& rtclog = log;
        RTC_ERROR(
            ("shutdown() in a callback: no thread can be started (%s); the manager ends when its program "
             "calls runManager() or shutdown()",
             e.what()));
    }
}

// Without a main loop, main() may return when terminationRequested() is true, and the process would exit before all
// components are deactivated. The handler runs before the static destructors of the modules, which are older.
void Manager::Impl::wait_for_end_at_exit() {
    std::atexit([] {
        Impl& impl = Manager::instance().impl();
        std::unique_lock<std::recursive_mutex> lock(impl.mutex);
        // A component that calls exit() cannot wait for its own end, and a set-up does not continue after exit().
        if (!impl.end_requested || impl.setting_up) return;
        if (impl.must_return_first() || impl.main_loop != std::thread::id()) return;
        const auto limit = 2 * host_options().stop_timeout;
        if (impl.end_changed.wait_for(lock, limit, [&] { return impl.has_ended; })) return;
        Logger& rtclog = impl.log;
        RTC_ERROR(("the program exits before the manager has ended"));
    });
}

// Wakes those who wait for the end, even if a step has thrown.
struct Manager::Impl::EndNotice {
    ~EndNotice() {
        std::lock_guard<std::recursive_mutex> lock(impl.mutex);
        impl.has_ended = true;
        impl.end_changed.notify_all();
    }
    Impl& impl;
};

bool Manager::Impl::end(Manager& manager) {
    std::unique_lock<std::recursive_mutex> lock(mutex);
    if (shut_down) {
        end_changed.wait(lock, [this] { return has_ended; });
        return ended_in_order;
    }
    shut_down = true;
    ending = std::this_thread::get_id();
    lock.unlock();
    const EndNotice notice{*this};
    return ended_in_order = end_in_order(manager);
}

void Manager::Impl::set_setting_up(bool value) {
    std::lock_guard<std::recursive_mutex> lock(mutex);
    setting_up = value;
    is_run = true;
    end_changed.notify_all();
}

void Manager::Impl::set_main_loop(std::thread::id thread) {
    std::lock_guard<std::recursive_mutex> lock(mutex);
    main_loop = thread;
    is_run = true;
}

void Manager::Impl::note_run() {
    std::lock_guard<std::recursive_mutex> lock(mutex);
    is_run = true;
}

} // namespace RTC
