// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/application_directory.hpp"
#include "host/opros/engine/connect/profile_connections.hpp"
#include "host/opros/engine/execute/component_host.hpp"
#include "host/opros/engine/execute/executor.hpp"
#include "host/opros/engine/late_start.hpp"
#include "host/process/bounded_call.hpp"
#include "host/rt/lock_step/step_server.hpp"

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
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
    /// If not empty, there are no executor threads: this socket steps the components (host/rt/lock_step/step_server.hpp).
    std::string lockstep_socket;
    /// The node whose part of the application runs here; empty: the profile's choice (node_part()).
    std::string node;
    /// If set, the set-up ends when a component cannot be loaded, initialized or started, or when a connection cannot
    /// be made. Otherwise such a component or connection is left out and the rest runs.
    bool strict = false;
    /// [main-thread] Called before each callback of the set-up, so that a message can name a callback that hangs.
    std::function<void(const std::string& component, const char* callback)> on_setup_step;
    /// [any-thread] Returns whether the host was asked to end. Components that wait for others need to know this.
    std::function<bool()> is_ending = [] { return false; };
    /// How long the end of the application waits for each callback that is still running.
    std::chrono::nanoseconds grace = std::chrono::seconds(10);
};

/// Runs an OPRoS application in this process, from its profile to its orderly end. The owner calls start() once and
/// then stop(), shut_down() or unload(); each of these three includes the ones before it. [main-thread] unless stated
/// otherwise.
class Application {
  public:
    /// Loads all components, initializes them and connects their ports. Throws SetupError.
    Application(const std::filesystem::path& profile, const ApplicationOptions& options);
    /// unload(). What a stuck component may still use is leaked.
    ~Application();

    /// Starts all components in reverse order of the list, unless <coordination> says otherwise. Then starts their
    /// executors or the lock-step server. Throws SetupError if no component has started, or if `strict` is set and one
    /// has failed.
    void start();
    /// Ends each component's executor and then stops the component, in the reverse order of start.
    void stop();
    /// Stops and disconnects the components and destroys them (onDestroy).
    void shut_down();
    /// Deletes the components' instances, then unloads their libraries. Afterwards no part of a component may be used.
    void unload();

    /// Returns the components that did not return from a callback or destructor within the grace time of stop(),
    /// shut_down() or unload(). Everything that they may still use stays in memory, and the process should exit without
    /// running static destructors.
    const std::vector<std::string>& stuck_components() const { return stuck_components_; }
    /// Returns the components whose libraries are still loaded after unload(). A library can request this (-z
    /// nodelete).
    const std::vector<std::string>& components_still_loaded() const { return components_still_loaded_; }
    /// Returns the components that could not be loaded, initialized or started, until unload().
    std::vector<std::string> components_not_running() const;
    /// Returns one line for each executor with its counters; filled by stop().
    const std::vector<std::string>& executor_stats() const { return executor_stats_; }

    /// [any-thread, one at a time] Runs one cycle of the named component in the calling thread. Throws
    /// std::runtime_error if there is no such component or the component has thrown an exception.
    void step(const std::string& component);

    /// Returns NULL if there is no component of this name or it could not be loaded. [any-thread]
    ComponentHost* find_component(const std::string& name);
    /// Returns the components that could be loaded, as listed in the profile, until unload(). [any-thread]
    const std::vector<std::unique_ptr<ComponentHost>>& components() const { return components_; }
    /// Makes transitions of components. [any-thread]
    ComponentDirectory& directory() { return directory_; }
    /// Returns the connections of the profile. The object lives until unload(). [main-thread]
    const ProfileConnections& connections() const { return *connections_; }

  private:
    /// The other constructor delegates to this one, so that the destructor runs if the rest of the other one throws.
    explicit Application(const ApplicationOptions& options);
    void load(const ApplicationProfile& profile);
    void sort_components(const ApplicationProfile& profile);
    void initialize_all();
    void initialize(ComponentHost& component);
    void announce_setup_callback(const ComponentHost& component, const char* callback) const;
    void require_success_if_strict(const ComponentHost& component, const char* transition) const;

    bool may_start_late(const ComponentHost& component) const;
    void start_late();
    template <class Helper>
    void end_bounded(std::shared_ptr<Helper>& helper);
    void stop_components(const std::vector<ComponentHost*>& components);
    void stop_task_queues();
    void unload_libraries();
    process::BoundedCall::Series bounded_series(const std::vector<ComponentHost*>& components);
    void run_bounded(const std::vector<ComponentHost*>& components, void (ComponentHost::*step)());
    bool is_stuck(const ComponentHost& component) const;
    void mark_stuck(const ComponentHost& component);

    ApplicationOptions options_;
    // One component's queue may hold a value that another component's code has created. Libraries are therefore
    // released after all components.
    std::vector<std::shared_ptr<plugin::Library>> libraries_;
    std::vector<std::unique_ptr<ComponentHost>> components_; // as listed in the profile
    ApplicationDirectory directory_{components_, options_.is_ending};
    std::vector<ComponentHost*> start_order_;
    std::unique_ptr<ProfileConnections> connections_ = std::make_unique<ProfileConnections>();
    std::vector<std::unique_ptr<Executor>> executors_;
    std::shared_ptr<rt::StepServer> step_server_;
    std::set<std::string> users_of_nodes_; ///< components that require services of other nodes
    std::shared_ptr<LateStart> late_start_;
    std::vector<std::string> left_out_; ///< components that could not be loaded
    std::vector<std::string> stuck_components_, components_still_loaded_, executor_stats_;
    bool started_ = false, shut_down_ = false, unloaded_ = false;
};

} // namespace tandem::engine
