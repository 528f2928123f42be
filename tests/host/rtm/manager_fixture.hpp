// SPDX-License-Identifier: Apache-2.0
// The process's manager for a test, as a rule in lock-step mode: cycles run when the test calls step().
#pragma once
#include "components.hpp"
#include "host/rtm/runtime/manager/manager_options.hpp"
#include <catch2/catch.hpp>

namespace testing {

/// Starts the manager with the test components registered and the log off; shuts it down at the end. A process has
/// one manager, so each test case runs in a separate process.
class ManagerFixture {
  public:
    /// `lockstep` false: contexts have their threads. `settings`: `key:value` each, as with -o.
    explicit ManagerFixture(bool lockstep = true, std::vector<std::string> settings = {},
                            std::chrono::nanoseconds tick_spin = {})
        : manager_(start(lockstep, settings, tick_spin)) {
        register_test_components(manager_);
    }
    ~ManagerFixture() { manager_.shutdown(); }

    /// Throws RTC::ManagerError, as Manager::createOrThrow() does.
    template <class Component>
    Component& create(const std::string& args) {
        return dynamic_cast<Component&>(manager_.createOrThrow(args));
    }
    void connect(const std::string& line) { manager_.connectOrThrow(line); }
    static RTC::ReturnCode_t activate(RTC::RTObject_impl& rtc) { return rtc.activate(0); }
    /// One cycle of the component's own contexts, in the calling thread.
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
