// SPDX-License-Identifier: Apache-2.0
#ifndef TANDEM_RTCMANAGERREQUIRED_H_
#define TANDEM_RTCMANAGERREQUIRED_H_

#include <RequiredMethod.h>
#include <RequiredServicePort.h>

#include <string>
#include <vector>

/// The service RtcManager of an AdaptorComp whose InterceptorComp has `manage=yes`. A manager is HOST:PORT, or an empty
/// text for the RTM host behind the link. An RTC is `Name0` of that host, rtcname://HOST:PORT/CONTEXT/Name0.rtc or
/// rtcloc://HOST:PORT/Name0. Each method throws MethodInvokeException, one line, if it fails.
class RtcManagerRequired : public RequiredServicePort {
  public:
    typedef std::vector<std::string> Names;

    RtcManagerRequired() {
        m_load = reinterpret_cast<RequiredMethod<void>*>(
            add(makeRequiredMethod(&RtcManagerRequired::load, "load")));
        m_create = reinterpret_cast<RequiredMethod<std::string>*>(
            add(makeRequiredMethod(&RtcManagerRequired::create, "create")));
        m_list = reinterpret_cast<RequiredMethod<Names>*>(
            add(makeRequiredMethod(&RtcManagerRequired::list, "list")));
        m_configure = reinterpret_cast<RequiredMethod<void>*>(
            add(makeRequiredMethod(&RtcManagerRequired::configure, "configure")));
        m_activate = reinterpret_cast<RequiredMethod<void>*>(
            add(makeRequiredMethod(&RtcManagerRequired::activate, "activate")));
        m_deactivate = reinterpret_cast<RequiredMethod<void>*>(
            add(makeRequiredMethod(&RtcManagerRequired::deactivate, "deactivate")));
        void (RtcManagerRequired::*const reset_rtc)(std::string) = &RtcManagerRequired::reset;
        m_reset = reinterpret_cast<RequiredMethod<void>*>(add(makeRequiredMethod(reset_rtc, "reset")));
        m_state = reinterpret_cast<RequiredMethod<std::string>*>(
            add(makeRequiredMethod(&RtcManagerRequired::state, "state")));
        m_exit = reinterpret_cast<RequiredMethod<void>*>(
            add(makeRequiredMethod(&RtcManagerRequired::exit, "exit")));
    }

    /// Loads a module (a library) with component types.
    void load(std::string manager, std::string module) { (*m_load)(manager, module); }
    /// Creates an RTC from `Type` or `Type?key=value&...`. Returns the name that the methods below expect.
    std::string create(std::string manager, std::string type) { return (*m_create)(manager, type); }
    /// Returns the names of the manager's RTCs.
    Names list(std::string manager) { return (*m_list)(manager); }
    /// Sets a parameter of the active configuration set.
    void configure(std::string rtc, std::string parameter, std::string value) {
        (*m_configure)(rtc, parameter, value);
    }
    void activate(std::string rtc) { (*m_activate)(rtc); }
    void deactivate(std::string rtc) { (*m_deactivate)(rtc); }
    using RequiredServicePort::reset; // of a port, without an argument
    void reset(std::string rtc) { (*m_reset)(rtc); }
    /// Returns INACTIVE, ACTIVE or ERROR, the state in the first execution context.
    std::string state(std::string rtc) { return (*m_state)(rtc); }
    void exit(std::string rtc) { (*m_exit)(rtc); }

  private:
    Method* add(Method* method) {
        addMethod(method->getName(), method);
        return method;
    }
    RequiredMethod<void>* m_load;
    RequiredMethod<std::string>* m_create;
    RequiredMethod<Names>* m_list;
    RequiredMethod<void>* m_configure;
    RequiredMethod<void>* m_activate;
    RequiredMethod<void>* m_deactivate;
    RequiredMethod<void>* m_reset;
    RequiredMethod<std::string>* m_state;
    RequiredMethod<void>* m_exit;
};

#endif
