// SPDX-License-Identifier: Apache-2.0
// An OPRoS application in this process, from its profile to its orderly end.
#pragma once

#include "host/opros/engine/connect/connection.hpp"
#include "host/opros/engine/execute/component_host.hpp"
#include "host/opros/engine/execute/executor.hpp"
#include "host/opros/engine/execute/worker_pool.hpp"
#include "host/rt/step_server.hpp"

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
    std::size_t jobs_per_worker = 1024;
    /// Not empty: no executor threads, components are stepped through this socket (host/rt/step_server.hpp).
    std::string lockstep_socket;
    /// A component that cannot be loaded, initialized or started, or a connection that cannot be made, ends
    /// the set-up; otherwise it is left out and the rest runs.
    bool strict = false;
    /// Told before each call-back of the set-up, with its name.
    std::function<void(const std::string& component, const char* call_back)> on_setup_step;
    /// How long the end waits for each call-back that is under way.
    std::chrono::nanoseconds grace = std::chrono::seconds(10);
};

class Application {
  public:
    /// Loads and initialises all components and connects them. Throws SetupError.
    Application(const std::filesystem::path& profile, const ApplicationOptions& options);
    ~Application();

    /// Starts all components, last listed first unless <coordination> says otherwise, then their executors.
    /// One that fails is out and the rest runs; SetupError if strict, or if none has started.
    void start();
    /// In the reverse order of start: ends each component's executor, then stops the component.
    void stop();
    /// Stops, disconnects and destroys.
    void shut_down();
    /// Ends what has not ended yet, then the instances, then lets go of the libraries. Nothing of a component
    /// may be used afterwards. The destructor does it, too.
    void unload();
    /// Components that did not come back from a call-back or a destructor within the grace time of stop(),
    /// end() or unload(). What they may still use stays in memory for good, and the process had better leave
    /// without unloading anything.
    const std::vector<std::string>& stuck_components() const { return stuck_components_; }
    /// Components whose libraries have stayed loaded after unload(): a library may ask for that.
    const std::vector<std::string>& components_still_loaded() const { return components_still_loaded_; }
    /// A line for each executor with what it has counted, from stop() on.
    const std::vector<std::string>& executor_stats() const { return executor_stats_; }

    /// One cycle of the named component in the calling thread. Throws std::runtime_error: no such component,
    /// or it threw an exception.
    void step(const std::string& component);

    ComponentHost* find_component(const std::string& component);
    const std::vector<ComponentHost*>& components_in_start_order() const { return order_; }

  private:
    explicit Application(
        const ApplicationOptions& options); // what has been set up is undone if the rest throws
    void load(const ApplicationProfile& profile);
    void sort_components(const ApplicationProfile& profile);
    void connect_all(const ApplicationProfile& profile);
    void connect_ports(const ConnectionProfile& connection);
    void report_setup_step(const ComponentHost& component, const char* call_back) const;
    void require_success_if_strict(const ComponentHost& component, const char* step) const;
    void stop_component(ComponentHost& component);
    void stop_workers();
    void run_bounded(ComponentHost& component, void (ComponentHost::*step)());
    void mark_stuck(const ComponentHost& component);

    ApplicationOptions options_;
    // A value in one component's queue may be of another one's making: libraries go after all components.
    std::vector<std::shared_ptr<plugin::Library>> libraries_;
    std::vector<std::unique_ptr<ComponentHost>> components_; // as listed in the profile
    std::vector<ComponentHost*> order_;
    std::shared_ptr<WorkerPool> workers_;
    std::vector<std::unique_ptr<Connection>> connections_;
    std::vector<std::unique_ptr<Executor>> executors_;
    std::shared_ptr<rt::StepServer> step_server_;
    std::vector<std::string> stuck_components_, components_still_loaded_, executor_stats_;
    bool started_ = false, ended_ = false, unloaded_ = false;
};

} // namespace tandem::engine
