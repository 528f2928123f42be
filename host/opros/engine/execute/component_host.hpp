// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/execute/input_signal.hpp"
#include "host/opros/engine/execute/task_queue.hpp"
#include "host/opros/engine/profile/application_profile.hpp"
#include "host/plugin/library.hpp"
#include "host/plugin/parallel_probes.hpp"
#include "host/process/log_throttle.hpp"
#include "host/process/published/component_states.hpp"
#include "host/process/published/notices.hpp"
#include "host/rt/short_mutex.hpp"

#include <Component.h>
#include <ComponentDirectory.h>
#include <InputDataPortInterface.h>
#include <LifecycleListener.h>
#include <OutputDataPortInterface.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tandem::engine {

struct ComponentHostOptions {
    std::vector<std::filesystem::path> plugin_dirs; ///< folders for component and device libraries
    std::shared_ptr<plugin::ParallelProbes>
        probes; ///< try the library in a child process; NULL: nothing does
    std::size_t task_queue_capacity = 1024;
    TaskQueue::Mode task_mode = TaskQueue::Mode::own_thread;
};

/// One component of the application: its profile, library and instance, and the data that the engine needs to run it.
/// The engine calls all code of the component through this class. The class catches every exception, which puts this
/// component in ERROR and does not propagate. [main-thread] unless stated otherwise.
class ComponentHost {
  public:
    /// Loads the library, creates the instance and sets its properties. Throws SetupError.
    ComponentHost(const Subcomponent& entry, ComponentProfile profile, const ComponentHostOptions& options);

    const std::string& name() const { return name_; }
    const ComponentProfile& profile() const { return profile_; }
    Component& component() { return *component_; }
    const std::shared_ptr<plugin::Library>& library() const { return library_; }
    /// Returns an address inside the library.
    const void* code() const { return code_; }
    /// [any-thread] Returns whether the component is in the state in which it is executed.
    bool is_active() { return component_->getStatus() == OPROS_CS_ACTIVE; }
    /// [any-thread] Returns whether its initialization has failed. The component is then neither connected nor
    /// executed.
    bool has_failed() const { return failed_; }
    /// Returns whether start() has failed or could not be tried. The component is then in ERROR until a request makes
    /// it recover and start.
    bool has_not_started() const { return failed_ || start_failed_; }

    /// Life-cycle transitions. If a callback fails or throws, one line is logged and the component goes to ERROR.
    /// stop() and destroy() do nothing in a state in which there is nothing to stop or destroy.
    void initialize();
    void start();
    void stop();
    void destroy();
    /// [any-thread] Does what ComponentDirectory promises, between two cycles of the component. Waits at most 5 s for
    /// the current cycle.
    std::string request(ComponentTransition transition);
    /// [any-thread] Requests recovery and start if the component is in ERROR. Returns whether it has left ERROR. Logs a
    /// failure only if it differs from the previous one.
    bool start_again();
    void set_property(const std::string& name, const std::string& value);
    /// [any-thread] Sets a property between two cycles, in the calling thread. Waits at most 5 s for the current cycle.
    /// Returns an empty text, or the reason in one line why it waits until that cycle has ended.
    std::string configure(const std::string& name, const std::string& value);
    /// [any-thread] Reads the properties between two cycles. Waits at most 1 s for the current cycle; returns nothing if it
    /// does not end.
    std::optional<std::map<std::string, std::string>> properties();
    /// [any-thread] Returns why the component has last gone to ERROR, in one line; empty if it never has.
    std::string last_error() const;
    /// Deletes the instance. Afterwards no function of the component may be called, but its library stays loaded.
    void destroy_instance();
    /// Ends this object's use of the library. The library is unloaded when its last user ends its use.
    void unload_library();

    /// [executor] Run the two passes of a cycle, onExecute and onUpdated, if the component is ACTIVE. An exception puts the
    /// component in ERROR; they return its text, otherwise an empty string. In a rehearsal (host/rt/rehearsal.hpp)
    /// execute() does not call the component.
    std::string execute();
    std::string update();

    /// [executor] Publishes since when the component is in its cycle, in ns of CLOCK_MONOTONIC; 0: it is in none. For a
    /// component without a period, whose cycles are not ticks.
    void publish_cycle(std::int64_t since_ns) noexcept { published_state_->set_in_cycle_since(since_ns); }

    /// [any-thread] Runs code that calls the component and catches its exceptions as described above. `callback` is the
    /// name for messages and for current_callback(); it must live as long as the call. Returns the same as execute().
    std::string run_guarded(const char* callback, const std::function<void()>& code);

    /// [any-thread] Returns the callback that the component is in, or NULL. If several threads are in callbacks, the
    /// one that has been there longest counts.
    const char* current_callback() const;

    /// Returns the queue of events and non-blocking calls for the component.
    const std::shared_ptr<TaskQueue>& task_queue() const { return task_queue_; }

    /// Returns the signal that is set when an input has arrived. Data ports set it from initialize() on.
    InputSignal& input_signal() { return input_signal_; }
    /// [any-thread] Adds a port that the component adds after initialize(). Does nothing unless it is a data port.
    void add_data_port(const std::string& name, Port& port);
    void remove_data_port(const std::string& name);

    /// [executor] Returns the number of values that wait for the component at all of its input ports.
    std::size_t waiting_value_count() const;
    /// [executor] Returns whether an input port has a source that must be polled.
    bool has_polled_sources() const;

    /// Makes each cycle of this component require a preceding cycle of `target` from now on. Throws SetupError if the
    /// component depends on more than 64 components.
    void add_dependency(ComponentHost& target);
    /// [executor of this component] Tells the components that depend on this one that a cycle is over.
    void notify_dependents();
    /// [executor of this component] Returns whether each component it depends on has run a cycle since this function
    /// last returned true. Without dependencies always returns true.
    bool consume_dependency_cycles();

  private:
    /// Publishes the component, its state, and in ERROR the reason for observers of this process.
    class PublishedState final : public LifecycleListener {
      public:
        PublishedState(Component& component, const ComponentProfile& profile);
        ~PublishedState() override;
        void set_in_cycle_since(std::int64_t ns) noexcept { published_.set_in_cycle_since(ns); }
        /// [any-thread] Sets the reason for the next or current stay in ERROR; empty: none.
        void set_reason(const std::string& text);

      private:
        void stateChanged(LifecycleState state) override;
        void publish_reason(); // under mutex_
        Component& component_;
        process::OwnComponentState published_;
        std::mutex mutex_;
        bool in_error_ = false;
        std::string reason_;
        std::optional<process::OwnNotice> notice_;
    };

    /// Returns in one line, which is already logged, why the transition has failed; empty if it has succeeded.
    std::string run_transition(const char* callback, ReturnType (LifecycleInterface::*transition)());
    std::string make_transition(ComponentTransition transition);
    std::string stop_inactive(LifecycleState state);
    std::unique_lock<rt::ShortMutex> wait_for_cycle(std::chrono::milliseconds timeout);
    void set_last_error(const std::string& text);
    bool is_known_error(const std::string& text) const;
    void apply_properties();
    /// Logs the exception of the callback and puts an ACTIVE component in ERROR. Returns the text for execute() to return.
    std::string enter_error(const char* callback, const std::string& why);
    template <class Code>
    std::string guard(const char* callback, const Code& code);
    void fail_set_up();
    void configure_data_ports();
    void rehearse_ports();
    void note_lines() const;
    void log_return_code(const char* callback, ReturnType code, ReturnType& last);
    void log_if_component_stopped_itself();

    // First what each cycle uses, in as few cache lines as possible (note_lines()).
    alignas(64) std::string name_;
    // Declared before the instance and so destroyed after it, because the code of the instance is in the library.
    std::shared_ptr<plugin::Library> library_;
    std::shared_ptr<Component> component_;
    const void* code_ = nullptr; // an address in the library, for the report of a crash
    rt::ShortMutex cycle_mutex_; // held during a pass of a cycle and during a requested transition
    std::atomic<bool> has_new_properties_{false};
    ReturnType last_execute_ = OPROS_SUCCESS, last_update_ = OPROS_SUCCESS;
    // One bit for each component that this one depends on: the required ones, and the ones that have run a cycle.
    std::uint64_t dependency_mask_ = 0;
    std::atomic<std::uint64_t> completed_dependencies_{0};
    /// The components that depend on this one, each with the bit of this component in its masks.
    std::vector<std::pair<ComponentHost*, std::uint64_t>> dependents_;

    ComponentProfile profile_;
    std::vector<std::filesystem::path> plugin_dirs_;
    std::optional<PublishedState> published_state_;
    InputSignal input_signal_;
    std::shared_ptr<TaskQueue> task_queue_;
    mutable rt::ShortMutex data_ports_mutex_;
    template <class DataPort>
    using NamedPorts = std::vector<std::pair<std::string, DataPort*>>; // few; walked in each rehearsal
    NamedPorts<InputDataPortInterface> input_ports_;
    NamedPorts<OutputDataPortInterface> output_ports_;
    std::atomic<bool> failed_{false};
    bool initialized_ = false, start_failed_ = false;
    std::atomic<bool> error_logged_{false};
    std::mutex properties_mutex_;
    std::vector<std::pair<std::string, std::string>> new_properties_; // not yet set
    mutable std::mutex last_error_mutex_;
    std::string last_error_;  // under last_error_mutex_
    std::string known_error_; // of the previous attempt of start_again(); under last_error_mutex_
    process::LogThrottle failed_calls_;
};

} // namespace tandem::engine
