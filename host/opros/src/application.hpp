// SPDX-License-Identifier: Apache-2.0
// An OPRoS application in this process, from its profile to its orderly end.
#pragma once

#include "host/opros/src/component_host.hpp"
#include "host/opros/src/executor.hpp"
#include "host/opros/src/link.hpp"
#include "host/opros/src/worker_pool.hpp"
#include "host/rt/step_server.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tandem::engine {

struct ApplicationOptions {
    std::vector<std::filesystem::path> plugin_dirs;
    std::optional<plugin::Probe> probe; ///< libraries are tried in a child process of this program first
    ExecutorOptions executors;
    std::size_t workers = 4;
    std::size_t jobs_per_worker = 1024;
    /// Not empty: no executor threads, components are stepped through this socket (host/rt/step_server.hpp).
    std::string lockstep_socket;
    /// A component that fails to initialize or start ends the set-up; otherwise it is left out and the rest
    /// runs.
    bool strict = false;
};

class Application {
  public:
    /// Loads and initialises all components and connects them. Throws SetupError.
    Application(const std::filesystem::path& profile, const ApplicationOptions& options);
    /// Stops what runs, disconnects, destroys and unloads.
    ~Application();

    /// Starts all components, last listed first unless <coordination> says otherwise, then their executors.
    /// One that fails is out and the rest runs, or, if strict, SetupError is thrown.
    void start();
    /// In the reverse order of start: ends each component's executor, then stops the component.
    void stop();

    /// One cycle of the named component in the calling thread. Throws std::runtime_error: no such component,
    /// or it threw an exception.
    void step(const std::string& component);

    ComponentHost* find(const std::string& component);
    const std::vector<ComponentHost*>& in_start_order() const { return order_; }

  private:
    explicit Application(
        const ApplicationOptions& options); // what has been set up is undone if the rest throws
    void load(const ApplicationProfile& profile);
    void order(const ApplicationProfile& profile);
    void connect_all(const ApplicationProfile& profile);
    void demand_success(const ComponentHost& component, const char* step) const;

    ApplicationOptions options_;
    // A value in one component's queue may be of another one's making: libraries go after all components.
    std::vector<std::shared_ptr<plugin::Library>> libraries_;
    std::vector<std::unique_ptr<ComponentHost>> components_; // as listed in the profile
    std::vector<ComponentHost*> order_;
    WorkerPool workers_;
    std::vector<std::unique_ptr<Link>> links_;
    std::vector<std::unique_ptr<Executor>> executors_;
    std::unique_ptr<rt::StepServer> step_server_;
    bool started_ = false;
};

} // namespace tandem::engine
