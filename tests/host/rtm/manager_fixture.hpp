// SPDX-License-Identifier: Apache-2.0
// A manager without threads of its own: cycles run when a test says so.
#pragma once
#include "components.hpp"
#include "host/rtm/runtime/manager/manager_options.hpp"
#include <catch2/catch.hpp>

namespace testing {

/// The process's manager with the test components; ended when the test case ends (one test case per process).
class ManagerFixture {
  public:
    explicit ManagerFixture(bool lockstep = true, std::vector<std::string> settings = {},
                            std::chrono::nanoseconds tick_spin = {})
        : manager_(start(lockstep, settings, tick_spin)) {
        register_test_components(manager_);
    }
    ~ManagerFixture() { manager_.shutdown(); }

    template <class Component>
    Component& create(const std::string& args) {
        return dynamic_cast<Component&>(manager_.createOrThrow(args));
    }
    void connect(const std::string& line) { manager_.connectOrThrow(line); }
    static RTC::ReturnCode_t activate(RTC::RTObject_impl& rtc) { return rtc.activate(0); }
    void step(RTC::RTObject_impl& rtc) { manager_.step(rtc.getInstanceName()); }
    static RTC::LifeCycleState state(RTC::RTObject_impl& rtc) {
        RTC::ExecutionContext_var context = rtc.get_context(0);
        RTC::RTObject_var self = rtc.getObjRef();
        return context->get_component_state(self.in());
    }
    RTC::Manager& manager() { return manager_; }

  private:
    static RTC::Manager& start(bool lockstep, const std::vector<std::string>& settings,
                               std::chrono::nanoseconds tick_spin) {
        std::vector<std::string> args{"test", "-o", "logger.log_level:SILENT", "-o", "naming.enable:NO"};
        for (const auto& setting : settings) {
            args.push_back("-o");
            args.push_back(setting);
        }
        coil::Argv argv(args);
        RTC::Manager::Options options;
        options.lockstep = lockstep;
        options.tick_spin = tick_spin;
        return RTC::Manager::start(static_cast<int>(argv.size()), argv.get(), options);
    }
    RTC::Manager& manager_;
};

} // namespace testing
