// SPDX-License-Identifier: Apache-2.0
// One component of the application: its library, its instance and its profile. Whatever the component throws
// ends here.
#pragma once

#include "host/opros/engine/execute/input_signal.hpp"
#include "host/opros/engine/profile/profile.hpp"
#include "host/plugin/library.hpp"
#include "host/plugin/probe.hpp"
#include "host/process/log_throttle.hpp"

#include <Component.h>
#include <InputDataPortInterface.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tandem::engine {

class ComponentHost {
  public:
    /// Loads the library and makes the instance. Throws SetupError.
    ComponentHost(const Subcomponent& entry, ComponentProfile profile,
                  const std::vector<std::filesystem::path>& dirs,
                  const std::optional<plugin::ProbeOptions>& probe = std::nullopt);

    const std::string& name() const { return name_; }
    const ComponentProfile& profile() const { return profile_; }
    Component& component() { return *component_; }
    const std::shared_ptr<plugin::Library>& library() const { return library_; }
    bool is_active() { return component_->getStatus() == OPROS_CS_ACTIVE; }
    /// Initialisation or start has failed: the component takes no part.
    bool has_failed() const { return failed_; }

    /// Life-cycle steps. A failure is logged in one line and the component goes to ERROR; the others go on.
    void initialize();
    void start();
    void stop();
    void destroy();
    /// Ends the instance; then lets go of the library. Nothing of the component may be used any more.
    void destroy_instance();
    void unload_library();

    /// [executor] The two passes of a cycle; nothing happens unless the component is ACTIVE. An exception
    /// puts it in ERROR and comes back as text, empty otherwise.
    /// A warm_up (rt::TickOptions) goes the same way, but calls nothing of the component.
    std::string execute(bool warm_up = false);
    std::string update();

    /// Runs the component's own code from any thread of the engine, under the same rule.
    std::string run_guarded(const char* what, const std::function<void()>& code);

    /// The call-back that the component is in, of a thread that has come in last; NULL when it is in none.
    const char* current_callback() const { return current_callback_; }

    /// [executor] What has come for the component. Ports count from the time of initialize().
    InputSignal& input_signal() { return input_signal_; }
    std::size_t queued_value_count() const;
    bool has_sources() const;

    /// Cycles of these components must come before each of ours: notify_dependents() is theirs, consume_dependency_cycles() ours.
    /// Throws SetupError when there are more than 64.
    void add_dependency(ComponentHost& target);
    void notify_dependents();
    bool consume_dependency_cycles();

  private:
    bool run_transition(const char* what, ReturnType (LifecycleInterface::*step)());
    std::string enter_error(const char* what, const std::string& why);
    void log_return_code(const char* what, ReturnType code, ReturnType& last);
    void log_own_error();
    void configure_input_ports();
    void mark_failed();

    std::string name_;
    ComponentProfile profile_;
    std::shared_ptr<plugin::Library> library_;
    std::shared_ptr<Component> component_;
    InputSignal input_signal_;
    std::vector<InputDataPortInterface*> input_ports_;
    std::atomic<const char*> current_callback_{nullptr};
    std::atomic<bool> failed_{false};
    bool initialized_ = false;
    bool error_reported_ = false;
    process::LogThrottle failed_calls_;
    ReturnType last_execute_ = OPROS_SUCCESS, last_update_ = OPROS_SUCCESS;
    std::uint64_t dependency_mask_ = 0;
    std::atomic<std::uint64_t> completed_dependencies_{0};
    std::vector<std::pair<ComponentHost*, std::uint64_t>> dependents_;
};

} // namespace tandem::engine
