// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/execute/input_signal.hpp"
#include "host/opros/engine/execute/task_queue.hpp"
#include "host/opros/engine/profile/application_profile.hpp"
#include "host/plugin/library.hpp"
#include "host/plugin/parallel_probes.hpp"
#include "host/process/log_throttle.hpp"
#include "host/rt/short_mutex.hpp"

#include <Component.h>
#include <ComponentDirectory.h>
#include <InputDataPortInterface.h>
#include <OutputDataPortInterface.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace tandem::engine {

struct ComponentHostOptions {
    std::vector<std::filesystem::path> plugin_dirs; ///< where the component's and device libraries may be
    std::shared_ptr<plugin::ParallelProbes>
        probes; ///< try the library in a child process; NULL: nothing does
    std::size_t task_queue_capacity = 1024;
    TaskQueue::Mode task_mode = TaskQueue::Mode::own_thread;
};

/// One component of the application: its profile, library and instance, and what the engine needs to run it. All
/// code of the component is called through this class, which catches whatever it throws: an exception puts this
/// component in ERROR and goes no further. [main-thread] where nothing else is said.
class ComponentHost {
  public:
    /// Loads the library, creates the instance and sets its properties. Throws SetupError.
    ComponentHost(const Subcomponent& entry, ComponentProfile profile, const ComponentHostOptions& options);

    const std::string& name() const { return name_; }
    const ComponentProfile& profile() const { return profile_; }
    Component& component() { return *component_; }
    const std::shared_ptr<plugin::Library>& library() const { return library_; }
    /// An address inside the library.
    const void* code() const { return code_; }
    /// [any-thread] Whether the component is in the state in which it is executed.
    bool is_active() { return component_->getStatus() == OPROS_CS_ACTIVE; }
    /// [any-thread] Whether its initialization has failed: it is not connected and not executed.
    bool has_failed() const { return failed_; }
    /// Whether start() has failed, or could not be tried: the component is in ERROR, until somebody requests that it
    /// recovers and starts.
    bool has_not_started() const { return failed_ || start_failed_; }

    /// Transitions of the life cycle. A callback that fails or throws is logged in one line and the component
    /// goes to ERROR. stop() and destroy() do nothing in a state that has nothing to stop or destroy.
    void initialize();
    void start();
    void stop();
    void destroy();
    /// [any-thread] What ComponentDirectory promises, between two cycles of the component. Waits at most 5 s for the
    /// cycle under way.
    std::string request(ComponentTransition transition);
    void set_property(const std::string& name, const std::string& value);
    /// Deletes the instance: nothing of the component may be called any more, but its library stays.
    void destroy_instance();
    /// Ends this object's use of the library, which is unloaded with the last user.
    void unload_library();

    /// [executor] The two passes of a cycle, onExecute and onUpdated; nothing is called unless the component is
    /// ACTIVE. Returns the text of an exception, which has put it in ERROR; empty otherwise.
    std::string execute();
    std::string update();
    /// [executor] Takes the path of execute(), to bring its code and data into the caches, without calling the
    /// component (rt::TickOptions).
    void warm_up();

    /// [any-thread] Runs code that calls the component, under the rule above. `callback` is its name, for
    /// messages and current_callback(); it must live as long as the call. Returns as execute() does.
    std::string run_guarded(const char* callback, const std::function<void()>& code);

    /// [any-thread] The callback that the component is in, NULL when it is in none. Of several threads, the one
    /// that has been in it longest counts.
    const char* current_callback() const;

    /// Events and non-blocking calls for the component.
    const std::shared_ptr<TaskQueue>& task_queue() const { return task_queue_; }

    /// Set when an input has arrived. Data ports count from initialize() on.
    InputSignal& input_signal() { return input_signal_; }
    /// [any-thread] A port that the component adds after initialize(); does nothing unless it is a data port.
    void add_data_port(const std::string& name, Port& port);
    void remove_data_port(const std::string& name);

    /// [executor] The values that wait for the component at all of its input ports.
    std::size_t waiting_value_count() const;
    /// [executor] Whether an input port has a source that must be polled.
    bool has_polled_sources() const;

    /// From now on each cycle of this component needs a cycle of `target` before it. Throws SetupError when it
    /// depends on more than 64 components.
    void add_dependency(ComponentHost& target);
    /// [executor of this component] Tells the components that depend on this one that a cycle is over.
    void notify_dependents();
    /// [executor of this component] Whether each component it depends on has had a cycle since the last time
    /// this returned true. Always true without dependencies.
    bool consume_dependency_cycles();

  private:
    /// Returns why the transition has failed, one line, which it has logged; empty when it has succeeded.
    std::string run_transition(const char* callback, ReturnType (LifecycleInterface::*transition)());
    std::string make_transition(ComponentTransition transition);
    void apply_properties();
    /// Logs what the callback threw and puts the component in ERROR. Returns the text that execute() returns.
    std::string enter_error(const char* callback, const std::string& why);
    template <class Code>
    std::string guard(const char* callback, const Code& code);
    void fail_set_up();
    void configure_data_ports();
    void warm_up_ports();
    void log_return_code(const char* callback, ReturnType code, ReturnType& last);
    void log_if_component_stopped_itself();

    enum class Pass { real, warm_up };
    std::string execute(Pass pass);

    std::string name_;
    ComponentProfile profile_;
    // Declared before the instance, and so destroyed after it: its code is in the library.
    std::shared_ptr<plugin::Library> library_;
    std::shared_ptr<Component> component_;
    const void* code_ = nullptr; // an address in the library, for the report of a crash
    InputSignal input_signal_;
    std::shared_ptr<TaskQueue> task_queue_;
    mutable rt::ShortMutex data_ports_mutex_;
    template <class DataPort>
    using NamedPorts = std::vector<std::pair<std::string, DataPort*>>; // few, and gone through in each cycle
    NamedPorts<InputDataPortInterface> input_ports_;
    NamedPorts<OutputDataPortInterface> output_ports_;
    std::atomic<bool> failed_{false};
    bool initialized_ = false, start_failed_ = false;
    std::atomic<bool> error_logged_{false};
    rt::ShortMutex cycle_mutex_; // held during a pass of a cycle and during a requested transition
    std::mutex properties_mutex_;
    std::vector<std::pair<std::string, std::string>> new_properties_; // not yet set
    std::atomic<bool> has_new_properties_{false};
    process::LogThrottle failed_calls_;
    ReturnType last_execute_ = OPROS_SUCCESS, last_update_ = OPROS_SUCCESS;
    // One bit for each component that this one depends on: those needed, and those that have had a cycle.
    std::uint64_t dependency_mask_ = 0;
    std::atomic<std::uint64_t> completed_dependencies_{0};
    /// The components that depend on this one, each with this one's bit in its masks.
    std::vector<std::pair<ComponentHost*, std::uint64_t>> dependents_;
};

} // namespace tandem::engine
