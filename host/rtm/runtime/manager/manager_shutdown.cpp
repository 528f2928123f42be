// SPDX-License-Identifier: Apache-2.0
// The end of the manager. OpenRTM-aist: Manager::shutdown(), shutdownComponents(), shutdownORB(). There a
// callback that does not return keeps the process alive; here every step has a time limit, and a component
// that exceeds it is left behind.
#include "host/process/bounded_call.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include <algorithm>
#include <atomic>
#include <future>
#include <thread>

namespace RTC {
namespace {

// Twice the time that a context waits for its callback: a context that gives up waiting has returned by then.
bool returns_in_time(std::function<void()> call) {
    return tandem::process::BoundedCall::returns_within(2 * host_options().stop_timeout, std::move(call));
}

// Stops the component's own contexts and deactivates it in each. A context that does not halt is passed over:
// its thread is still in a callback.
void halt_and_deactivate(RTObject_impl* component) {
    RTObject_var self = component->getObjRef();
    for (auto* context : component->getOwnContexts())
        if (context->stopThread() == RTC_OK && context->getComponentState(self.in()) == ACTIVE_STATE)
            context->deactivateComponent(self.in());
}

} // namespace

// All components are stopped before the first exits, because they may call each other while they stop.
// Returns false when one did not stop or exit in time.
bool Manager::stopComponents(std::vector<RTObject_impl*> components) {
    Logger& rtclog = m_impl->log;
    const std::size_t all = components.size();
    auto exceeds_time = [&](RTObject_impl* component, std::function<void()> call) {
        const std::string name(component->getInstanceName());
        if (returns_in_time(std::move(call))) return false;
        RTC_ERROR(("%s: a callback does not return; the host ends without waiting for it", name.c_str()));
        return true;
    };
    std::erase_if(components, [&](auto* component) {
        return exceeds_time(component, [component] { halt_and_deactivate(component); });
    });
    std::size_t exited = 0;
    for (auto* component : components) {
        // Shared with the call, which may outlive this function.
        auto result = std::make_shared<std::atomic<ReturnCode_t>>(RTC_ERROR);
        if (!exceeds_time(component, [component, result] { *result = component->exit(); }) &&
            *result == RTC_OK)
            ++exited;
    }
    return exited == all;
}

// Deletes the components that have exited. Without the mutex: a destructor may call the manager.
void Manager::cleanupComponents() {
    std::vector<Impl::Component> finalized;
    {
        std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
        finalized.swap(m_impl->finalized);
    }
    for (auto& component : finalized)
        m_impl->destroy_component(component.object->getInstanceName(),
                                  [component] { component.factory->destroy(component.object); });
}

void Manager::Impl::destroy_component(const std::string& name, std::function<void()> call) {
    if (returns_in_time(std::move(call))) return;
    Logger& rtclog = log;
    RTC_ERROR(("%s: its destructor does not return; the host goes on without waiting for it", name.c_str()));
    stopped_in_order = false;
}

bool Manager::shutdown() {
    {
        std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
        if (m_impl->shut_down) return true;
        m_impl->shut_down = true;
    }
    m_impl->listeners.manager_.forEach([](auto& listener) { listener.preShutdown(); });
    m_impl->connection_keeper->stop(); // before it restores connections that are taken down now
    unpublish_manager(*m_impl);
    auto components = getComponents();
    // Reverse order of creation: later components may use earlier ones.
    std::reverse(components.begin(), components.end());
    bool all_exited = stopComponents(components);
    m_impl->run_due_tasks();
    cleanupComponents();

    // orb->shutdown(true) waits for calls in progress, and a component's servant may never return from one.
    std::packaged_task<void()> end_orb([this] {
        m_impl->orb->shutdown(true);
        m_impl->orb->destroy();
    });
    auto ended = end_orb.get_future();
    std::thread(std::move(end_orb)).detach();
    if (ended.wait_for(host_options().stop_timeout) != std::future_status::ready) all_exited = false;
    m_impl->listeners.manager_.forEach([](auto& listener) { listener.postShutdown(); });
    close_log_streams(*m_impl);
    if (!all_exited) m_impl->stopped_in_order = false;
    return m_impl->stopped_in_order;
}

} // namespace RTC
