// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/application_directory.hpp"
#include "host/opros/engine/connect/profile_connections.hpp"
#include "host/opros/engine/execute/component_host.hpp"
#include "host/opros/engine/execute/executor.hpp"
#include "host/rt/step_server.hpp"

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tandem::engine {

struct ApplicationOptions {
    std::vector<std::filesystem::path> plugin_dirs;
    std::optional<plugin::ProbeOptions>
        probe; ///< libraries are tried in a child process of this program first
    ExecutorOptions executors;
    std::size_t task_queue_capacity =
        1024; ///< events and non-blocking calls that may wait for each component
    /// Not empty: no executor threads, components are stepped through this socket (host/rt/step_server.hpp).
    std::string lockstep_socket;
    /// A component that cannot be loaded, initialized or started, or a connection that cannot be made, ends
    /// the set-up; otherwise it is left out and the rest runs.
    bool strict = false;
    /// [main-thread] Called before each callback of the set-up, so that one that hangs can be named.
    std::function<void(const std::string& component, const char* callback)> on_setup_step;
    /// [any-thread] Whether the host was asked to end, which components that wait for others want to know.
    std::function<bool()> is_ending = [] { return false; };
    /// How long the end of the application waits for each callback that is still running.
    std::chrono::nanoseconds grace = std::chrono::seconds(10);
};

/// An OPRoS application in this process, from its profile to its orderly end. Its owner calls start() once and
/// then stop(), shut_down() or unload(), each of which includes the one before. [main-thread] where nothing else
/// is said.
class Application {
  public:
    /// Loads all components, initializes them and connects their ports. Throws SetupError.
    Application(const std::filesystem::path& profile, const ApplicationOptions& options);
    /// unload(). What a stuck component may still use is leaked.
    ~Application();

    /// Starts all components, last listed first unless <coordination> says otherwise, then their executors or
    /// the lock-step server. Throws SetupError: a component has failed and `strict` is set, or none has started.
    void start();
    /// In the reverse order of start: ends each component's executor, then stops the component.
    void stop();
    /// Stops and disconnects the components and destroys them (onDestroy).
    void shut_down();
    /// Deletes the components' instances, then unloads their libraries. Nothing of a component may be used
    /// afterwards.
    void unload();

    /// Components that did not return from a callback or a destructor within the grace time of stop(),
    /// shut_down() or unload(). What they may still use stays in memory, and the process should exit without
    /// running static destructors.
    const std::vector<std::string>& stuck_components() const { return stuck_components_; }
    /// Components whose libraries have stayed loaded after unload(), as a library may ask for (-z nodelete).
    const std::vector<std::string>& components_still_loaded() const { return components_still_loaded_; }
    /// A line for each executor with what it has counted; filled by stop().
    const std::vector<std::string>& executor_stats() const { return executor_stats_; }

    /// [any-thread, one at a time] One cycle of the named component in the calling thread. Throws
    /// std::runtime_error: no such component, or it has thrown an exception.
    void step(const std::string& component);

    /// NULL when there is no component of this name, or it could not be loaded.
    ComponentHost* find_component(const std::string& name);
    const std::vector<ComponentHost*>& components_in_start_order() const { return start_order_; }

  private:
    /// Delegated to by the other constructor: when the rest of that one throws, the destructor runs.
    explicit Application(const ApplicationOptions& options);
    void load(const ApplicationProfile& profile);
    void sort_components(const ApplicationProfile& profile);
    void initialize_all();
    void initialize(ComponentHost& component);
    void announce_setup_callback(const ComponentHost& component, const char* callback) const;
    void require_success_if_strict(const ComponentHost& component, const char* transition) const;

    void stop_component(ComponentHost& component);
    void stop_task_queues();
    void unload_libraries();
    void run_bounded(ComponentHost& component, void (ComponentHost::*step)());
    bool is_stuck(const ComponentHost& component) const;
    void mark_stuck(const ComponentHost& component);

    ApplicationOptions options_;
    // A value in one component's queue may have been created by another one's code: libraries are released
    // after all components.
    std::vector<std::shared_ptr<plugin::Library>> libraries_;
    std::vector<std::unique_ptr<ComponentHost>> components_; // as listed in the profile
    ApplicationDirectory directory_{components_, options_.is_ending};
    std::vector<ComponentHost*> start_order_;
    std::unique_ptr<ProfileConnections> connections_ = std::make_unique<ProfileConnections>();
    std::vector<std::unique_ptr<Executor>> executors_;
    std::shared_ptr<rt::StepServer> step_server_;
    std::vector<std::string> stuck_components_, components_still_loaded_, executor_stats_;
    bool started_ = false, shut_down_ = false, unloaded_ = false;
};

} // namespace tandem::engine
