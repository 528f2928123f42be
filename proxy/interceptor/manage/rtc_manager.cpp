// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/manage/rtc_manager.hpp"

#include "proxy/interceptor/engine/manager.hpp"
#include "proxy/interceptor/manage/rtc_lookup.hpp"

#include <rtm/idl/ManagerSkel.h>

#include <fmt/format.h>

namespace tandem::interceptor {
namespace {

using Strings = BuiltInService::Strings;

/// The manager at `HOST:PORT`, by the well-known key of OpenRTM-aist's managers.
RTM::Manager_var find_manager(RTC::Manager& manager, const std::string& address) {
    CORBA::ORB_var orb = manager.getORB();
    std::string reason = "expected HOST:PORT";
    RTM::Manager_var found;
    try {
        CORBA::Object_var object = orb->string_to_object(("corbaloc:iiop:" + address + "/manager").c_str());
        found = RTM::Manager::_narrow(object.in());
    } catch (const CORBA::SystemException& error) { // no address, or nobody answers there
        reason = error._name();
    }
    if (CORBA::is_nil(found.in()))
        throw OperationFailed(fmt::format("there is no RTM manager at '{}' ({})", address, reason));
    return found;
}

/// The name by which find_rtc() finds a component of that manager.
std::string full_name(const std::string& address, const std::string& instance) {
    return address.empty() ? instance : "rtcloc://" + address + "/" + instance;
}

std::string instance_name(RTC::RTObject_ptr rtc) {
    RTC::ComponentProfile_var profile = rtc->get_component_profile();
    return static_cast<const char*>(profile->instance_name);
}

Strings load(RTC::Manager& manager, const std::string& address, const std::string& module) {
    if (address.empty())
        engine::load_module(manager, module);
    else
        require_ok(find_manager(manager, address)->load_module(module.c_str(), ""),
                   fmt::format("manager {}: module {} is not loaded", address, module));
    return {};
}

Strings create(RTC::Manager& manager, const std::string& address, const std::string& type) {
    if (address.empty()) return {engine::create_component(manager, type).getInstanceName()};
    RTC::RTObject_var created = find_manager(manager, address)->create_component(type.c_str());
    if (CORBA::is_nil(created.in()))
        throw OperationFailed(
            fmt::format("manager {}: component {} is not created; its log says why", address, type));
    return {full_name(address, instance_name(created.in()))};
}

Strings list(RTC::Manager& manager, const std::string& address) {
    Strings names;
    if (address.empty()) {
        for (auto* rtc : manager.getComponents()) names.emplace_back(rtc->getInstanceName());
        return names;
    }
    RTC::RTCList_var all = find_manager(manager, address)->get_components();
    for (CORBA::ULong i = 0; i < all->length(); ++i)
        names.push_back(full_name(address, instance_name(all[i])));
    return names;
}

Strings configure(RTC::Manager& manager, const Strings& arguments) {
    const auto& [name, parameter, value] = std::tie(arguments[0], arguments[1], arguments[2]);
    const auto rtc = find_rtc(manager, name);
    const std::string set = CORBA_RTCUtil::get_active_configuration_name(rtc.in());
    // A component accepts a parameter that it does not have, without any effect.
    const coil::Properties present = CORBA_RTCUtil::get_configuration(rtc.in(), set);
    if (!present.findNode(parameter))
        throw OperationFailed(fmt::format("{}: configuration set {} has no parameter {}; it has {}", name,
                                          set, parameter, coil::flatten(present.propertyNames())));
    std::string why;
    try {
        if (CORBA_RTCUtil::set_configuration(rtc.in(), set, parameter, value)) return {};
    } catch (const SDOPackage::InvalidParameter& error) {
        why = fmt::format(": {}", error.description.in());
    }
    throw OperationFailed(fmt::format("{}: parameter {} of configuration set {} does not take '{}'{}", name,
                                      parameter, set, value, why));
}

const char* state_name(RTC::LifeCycleState state) {
    static constexpr const char* names[] = {"CREATED", "INACTIVE", "ACTIVE", "ERROR"};
    return state <= RTC::ERROR_STATE ? names[state] : "unknown";
}

std::string state_of(RTC::RTObject_ptr rtc) {
    RTC::LifeCycleState state{};
    return CORBA_RTCUtil::get_state(state, rtc) ? state_name(state) : "without a context";
}

using Transition = RTC::ReturnCode_t (*)(RTC::RTObject_ptr, RTC::UniqueId);

BuiltInService::Operation transition(RTC::Manager& manager, const char* participle, Transition request) {
    return [&manager, participle, request](const Strings& arguments) -> Strings {
        const auto rtc = find_rtc(manager, arguments[0]);
        const auto code = request(rtc.in(), 0);
        if (code != RTC::RTC_OK)
            require_ok(code,
                       fmt::format("{} is not {}, it is {}", arguments[0], participle, state_of(rtc.in())));
        return {};
    };
}

} // namespace

BuiltInService make_rtc_manager(RTC::Manager& manager) {
    BuiltInService service("RtcManager");
    service.add("load", "ss:", [&](const Strings& a) { return load(manager, a[0], a[1]); });
    service.add("create", "ss:s", [&](const Strings& a) { return create(manager, a[0], a[1]); });
    service.add("list", "s:as", [&](const Strings& a) { return list(manager, a[0]); });
    service.add("configure", "sss:", [&](const Strings& a) { return configure(manager, a); });
    service.add("activate", "s:", transition(manager, "activated", &CORBA_RTCUtil::activate));
    service.add("deactivate", "s:", transition(manager, "deactivated", &CORBA_RTCUtil::deactivate));
    service.add("reset", "s:", transition(manager, "reset", &CORBA_RTCUtil::reset));
    service.add("state", "s:s",
                [&](const Strings& a) -> Strings { return {state_of(find_rtc(manager, a[0]).in())}; });
    service.add("exit", "s:", [&](const Strings& a) -> Strings {
        require_ok(find_rtc(manager, a[0])->exit(), a[0] + " does not exit");
        return {};
    });
    return service;
}

} // namespace tandem::interceptor
