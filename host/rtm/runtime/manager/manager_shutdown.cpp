// SPDX-License-Identifier: Apache-2.0
// The end of the manager. OpenRTM-aist: Manager::shutdown(), shutdownComponents(), shutdownORB(). There a
// callback that does not return keeps the process alive; here every step has a time limit, and a component
// that exceeds it is left behind.
#include "host/crash/callback_scope.hpp"
#include "host/process/bounded_call.hpp"
#include "host/process/exit/exit_timer.hpp"
#include "host/process/start_thread.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include "host/rtm/runtime/network/sending_threads.hpp"
#include <algorithm>
#include <future>
#include <thread>
#include <utility>

namespace RTC {
namespace {

// Returns for example `onExecute of Camera0`. The name of the callback is missing if none of the component's callbacks
// is running, for instance while one of another component in its execution context runs.
std::string callback_text(const RTObject_impl* component, const std::string& name) {
    const auto running = tandem::crash::find_running_callback(component);
    return (running ? std::string(running->name) : "a callback") + " of " + name;
}

// Returns whether the component, whose exit() has returned, is no longer listed. Waits up to the stop timeout, because
// another thread that exits the component may be about to remove it from the list.
bool leaves_in_time(Manager& manager, const RTObject_impl* component, const std::string& name) {
    const auto timeout = host_options().stop_timeout;
    const auto end = std::chrono::steady_clock::now() + timeout;
    while (manager.getComponent(name.c_str()) == component) {
        const auto running = tandem::crash::find_running_callback(component);
        const auto now = std::chrono::steady_clock::now();
        if (now > end || (running && now - running->since > timeout)) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

// Stops the component's own contexts and deactivates the component in each. Skips a context that does not halt: its
// thread is still in a callback.
void halt_and_deactivate(RTObject_impl* component) {
    RTObject_var self = component->getObjRef();
    for (auto* context : component->getOwnContexts())
        if (context->stopThread() == RTC_OK && context->getComponentState(self.in()) == ACTIVE_STATE)
            context->deactivateComponent(self.in());
}

} // namespace

// Stops all components before the first one exits, because they may call each other while they stop. Returns false if
// one did not stop or exit in time. The limit is twice the time that a context waits for its callback, so a context
// that gives up waiting has returned by then.
bool Manager::stopComponents(std::vector<RTObject_impl*> components) {
    Logger& rtclog = m_impl->log;
    bool all_exited = true;
    auto leave_behind = [&](RTObject_impl* component, const std::string& name) {
        m_impl->leave_behind(callback_text(component, name));
        all_exited = false;
    };
    std::vector<std::string> names;
    names.reserve(components.size());
    for (const auto* component : components) names.emplace_back(component->getInstanceName());
    // Calls `step` for each component that has returned from the steps before.
    const auto run = [&](void (*step)(RTObject_impl*)) {
        tandem::process::BoundedCall::run_series(
            {components.size(),
             [components, step](std::size_t i) {
                 if (components[i] != nullptr) step(components[i]);
             },
             [](std::size_t) { return 2 * host_options().stop_timeout; },
             [&](std::size_t i) {
                 leave_behind(std::exchange(components[i], nullptr), names[i]);
                 return true;
             },
             [&](std::size_t i, std::chrono::seconds time) {
                 RTC_WARN(("%s has taken %ld s so far; the host waits for it",
                           callback_text(components[i], names[i]).c_str(), static_cast<long>(time.count())));
             },
             tandem::process::BoundedCall::WithoutThread::exit});
    };
    run(halt_and_deactivate);
    run([](RTObject_impl* component) { component->exit(); });
    // A component whose onFinalize has failed, which is logged, has exited nevertheless. A component that is still listed has
    // not exited: exit() has failed, or another call of exit() by a tool waits for a callback.
    for (std::size_t i = 0; i < components.size(); ++i)
        if (components[i] != nullptr && !leaves_in_time(*this, components[i], names[i]))
            leave_behind(components[i], names[i]);
    return all_exited;
}

// Deletes the components that have exited.
void Manager::cleanupComponents() {
    std::vector<Impl::Component> finalized;
    {
        std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
        if (m_impl->shut_down) return; // shutdown() has their addresses, and deletes them at its end
        finalized.swap(m_impl->finalized);
    }
    m_impl->destroy(finalized);
}

void Manager::Impl::destroy(const std::vector<Component>& exited) {
    std::vector<std::pair<std::string, std::function<void()>>> destructors;
    destructors.reserve(exited.size());
    for (const auto& component : exited)
        destructors.emplace_back(component.object->getInstanceName(),
                                 [component] { component.factory->destroy(component.object); });
    run_destructors(destructors);
}

void Manager::Impl::run_destructors(
    const std::vector<std::pair<std::string, std::function<void()>>>& destructors) {
    using WithoutThread = tandem::process::BoundedCall::WithoutThread;
    std::unique_lock<std::recursive_mutex> lock(mutex);
    const auto without_thread = shut_down ? WithoutThread::exit : WithoutThread::no_limit;
    lock.unlock();
    tandem::process::BoundedCall::run_series({destructors.size(),
                                              [destructors](std::size_t i) {
                                                  const auto& [name, destroy] = destructors[i];
                                                  const tandem::crash::CallbackScope scope(
                                                      nullptr, name.c_str(), "its destructor", nullptr);
                                                  destroy();
                                              },
                                              [](std::size_t) { return 2 * host_options().stop_timeout; },
                                              [&](std::size_t i) {
                                                  leave_behind("the destructor of " + destructors[i].first);
                                                  return true;
                                              },
                                              {},
                                              without_thread});
}

void Manager::Impl::leave_behind(const std::string& what) {
    Logger& rtclog = log;
    RTC_ERROR(("%s does not return; the host continues without waiting for it", what.c_str()));
    std::lock_guard<std::recursive_mutex> lock(mutex);
    left_behind.push_back(what);
}

std::string left_behind(Manager& manager) {
    std::lock_guard<std::recursive_mutex> lock(manager.impl().mutex);
    return coil::flatten(manager.impl().left_behind);
}

bool Manager::Impl::end_in_order(Manager& manager) {
    listeners.manager_.forEach([](auto& listener) { listener.preShutdown(); });
    connection_keeper->stop(); // before it can restore connections that are taken down now
    unpublish_manager(*this);
    auto components = manager.getComponents();
    // Reverse order of creation: later components may use earlier ones.
    std::reverse(components.begin(), components.end());
    const bool all_exited = manager.stopComponents(components);
    run_due_tasks();
    std::vector<Component> exited;
    {
        std::lock_guard<std::recursive_mutex> lock(mutex);
        exited.swap(finalized);
    }
    destroy(exited);

    // The connectors are gone, but a message may still be in transit to a process that hangs or cannot be reached, and a
    // service call of another process may still run.
    const bool all_sent = sending_threads_end_within(host_options().stop_timeout);
    if (!all_sent) leave_behind("a call to or from another process");
    // orb->shutdown(true) waits for calls in progress, and a component's servant may never return from one.
    const auto end_orb = std::make_shared<std::packaged_task<void()>>([this, all_sent] {
        orb->shutdown(true);
        if (all_sent) orb->destroy();
    });
    auto ended = end_orb->get_future();
    if (!tandem::process::start_detached([end_orb] { (*end_orb)(); })) {
        const tandem::process::ExitTimer limit(host_options().stop_timeout,
                                               "error: an operation that another process has called does not "
                                               "return; exiting without waiting for it",
                                               1);
        (*end_orb)();
    }
    // A call that has not ended by now has had its time, and has been named.
    const auto patience = all_sent ? host_options().stop_timeout : std::chrono::nanoseconds(0);
    if (ended.wait_for(patience) != std::future_status::ready && all_sent)
        leave_behind("an operation that another process has called");
    listeners.manager_.forEach([](auto& listener) { listener.postShutdown(); });
    close_log_streams(*this);
    return all_exited && manager.stoppedInOrder();
}

} // namespace RTC
