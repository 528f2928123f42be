// SPDX-License-Identifier: Apache-2.0
// The manager's end: nothing a component does, or does not do, keeps it from coming.
#include "host/process/bounded_call.hpp"
#include "host/rtm/runtime/manager/manager_impl.hpp"
#include <algorithm>
#include <atomic>
#include <future>
#include <thread>

namespace RTC {
namespace {

bool returns(std::function<void()> call) {
    return tandem::process::BoundedCall::returns_within(2 * host_options().stop_timeout, std::move(call));
}

void deactivate(RTObject_impl* component) {
    RTObject_var self = component->getObjRef();
    for (auto* context : component->getOwnContexts())
        if (context->halt() == RTC_OK && context->getComponentState(self.in()) == ACTIVE_STATE)
            context->deactivateComponent(self.in());
}

} // namespace

// All stop before any goes away: they may still talk to each other while they stop.
bool Manager::stopComponents(std::vector<RTObject_impl*> components) {
    Logger& rtclog = m_impl->log;
    const std::size_t all = components.size();
    auto hangs = [&](RTObject_impl* component, std::function<void()> call) {
        const std::string name(component->getInstanceName());
        if (returns(std::move(call))) return false;
        RTC_ERROR(("%s: a callback does not return; the component is left as it is", name.c_str()));
        return true;
    };
    std::erase_if(components, [&](auto* one) { return hangs(one, [one] { deactivate(one); }); });
    std::size_t ended = 0;
    for (auto* component : components) {
        auto result = std::make_shared<std::atomic<ReturnCode_t>>(RTC_ERROR);
        if (!hangs(component, [component, result] { *result = component->exit(); }) && *result == RTC_OK)
            ++ended;
    }
    return ended == all;
}

void Manager::cleanupComponents() {
    std::vector<Impl::Component> leaving;
    {
        std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
        leaving.swap(m_impl->finalized);
    }
    for (auto& one : leaving)
        m_impl->destroy_component(one.object->getInstanceName(), [one] { one.factory->destroy(one.object); });
}

void Manager::Impl::destroy_component(const std::string& name, std::function<void()> call) {
    if (returns(std::move(call))) return;
    Logger& rtclog = log;
    RTC_ERROR(("%s: its destructor does not return; the component is left as it is", name.c_str()));
    ended_in_order = false;
}

bool Manager::shutdown() {
    {
        std::lock_guard<std::recursive_mutex> lock(m_impl->mutex);
        if (m_impl->shut_down) return true;
        m_impl->shut_down = true;
    }
    m_impl->listeners.manager_.forEach([](auto& listener) { listener.preShutdown(); });
    m_impl->connection_keeper->stop(); // nothing is restored that is taken down now
    unpublish_manager(*m_impl);
    auto components = getComponents();
    std::reverse(components.begin(), components.end());
    bool all_ended = stopComponents(components);
    m_impl->run_due_tasks();
    cleanupComponents();

    std::packaged_task<void()> end_orb([this] {
        m_impl->orb->shutdown(true);
        m_impl->orb->destroy();
    });
    auto ended = end_orb.get_future();
    std::thread(std::move(end_orb)).detach();
    // A call into a component may hang for longer than anybody wants to wait.
    if (ended.wait_for(host_options().stop_timeout) != std::future_status::ready) all_ended = false;
    m_impl->listeners.manager_.forEach([](auto& listener) { listener.postShutdown(); });
    close_log_streams(*m_impl);
    if (!all_ended) m_impl->ended_in_order = false;
    return m_impl->ended_in_order;
}

} // namespace RTC
