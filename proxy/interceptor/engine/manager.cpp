// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/engine/manager.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <initializer_list>
#include <stdexcept>
#include <thread>

namespace tandem::interceptor::engine {

#ifdef TANDEM_RTM_PUBLIC_API

namespace {

std::atomic<bool> manager_ends{false};

class TerminationListener final : public RTM::ManagerActionListener {
  public:
    void preShutdown() override { manager_ends = true; }
    void postShutdown() override {}
    void preReinit() override {}
    void postReinit() override {}
};

} // namespace

void load_module(RTC::Manager& manager, const std::string& module) {
    if (manager.load(module, "") != RTC::RTC_OK)
        throw std::runtime_error("module " + module + " is not loaded; the manager's log says why");
}

RTC::RTObject_impl& create_component(RTC::Manager& manager, const std::string& arguments) {
    auto* created = manager.createComponent(arguments.c_str());
    if (!created)
        throw std::runtime_error("component " + arguments + " is not created; the manager's log says why");
    return *created;
}

// The manager's own deletion of a component that has not exited leaves its CORBA objects active.
void remove_component(RTC::Manager&, RTC::RTObject_impl& component) { component.exit(); }

void release_component(RTC::RTObject_impl* component) { component->_remove_ref(); }

void wait_until_removed(RTC::Manager& manager, const std::string& name) {
    constexpr auto pause = std::chrono::milliseconds(20);
    for (int i = 0; i < 150 && manager.getComponent(name.c_str()) != nullptr && !manager_ends; ++i)
        std::this_thread::sleep_for(pause);
}

bool is_terminating() { return manager_ends; }

void watch_termination(RTC::Manager& manager) {
    static std::atomic<bool> watches{false};
    // The manager deletes it.
    if (!watches.exchange(true)) manager.addManagerActionListener(new TerminationListener, true);
}

RTC::RTCList find_by_name(RTC::Manager& manager, const std::string& name, std::string& reason, CORBA::ULong) {
    RTC::RTCList found = manager.getNaming()->string_to_component(name);
    if (found.length() == 0) reason = "there is no RTC " + name;
    return found;
}

bool wants_arrivals(RTC::InPortBase&) { return true; }

#else

void load_module(RTC::Manager& manager, const std::string& module) { manager.loadOrThrow(module, ""); }

RTC::RTObject_impl& create_component(RTC::Manager& manager, const std::string& arguments) {
    return manager.createOrThrow(arguments);
}

void remove_component(RTC::Manager& manager, RTC::RTObject_impl& component) {
    manager.deleteComponent(&component);
}

void release_component(RTC::RTObject_impl* component) { RTC::deleteRTObject(component); }

void wait_until_removed(RTC::Manager&, const std::string&) {}

bool is_terminating() { return RTC::Manager::terminationRequested(); }

void watch_termination(RTC::Manager&) {}

RTC::RTCList find_by_name(RTC::Manager& manager, const std::string& name, std::string& reason,
                          CORBA::ULong timeout_ms) {
    return manager.getNaming()->string_to_component(name, reason, timeout_ms);
}

bool wants_arrivals(RTC::InPortBase& port) {
    using Type = RTC::ConnectorDataListenerType;
    const auto types = {Type::ON_BUFFER_WRITE,     Type::ON_BUFFER_FULL,   Type::ON_BUFFER_WRITE_TIMEOUT,
                        Type::ON_BUFFER_OVERWRITE, Type::ON_RECEIVED,      Type::ON_RECEIVER_FULL,
                        Type::ON_RECEIVER_TIMEOUT, Type::ON_RECEIVER_ERROR};
    return std::any_of(types.begin(), types.end(), [&](Type type) { return port.getListeners()->has(type); });
}

#endif

} // namespace tandem::interceptor::engine
