// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/tandem/run/run_folder.hpp"
#include "host/rt/lock_step/step_client.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tandem::command {

/// A component that runs in lock-step.
struct SteppedComponent {
    std::string host, name;
    std::chrono::nanoseconds period;
};

/// Returns the components of an application in the order of a tick: the OPRoS components in profile order, without the
/// passive ones, then the RTCs in their order of creation. Periods come from the profiles and from the RTCs' contexts,
/// which a child process reads. Throws std::runtime_error.
std::vector<SteppedComponent> find_stepped_components(const RunFolder& folder, const RunOptions& options);

/// Runs cycles of components of hosts started with `--lockstep SOCKET`. [one thread]
class HostSteps {
  public:
    HostSteps();
    ~HostSteps();
    HostSteps(const HostSteps&) = delete;
    HostSteps& operator=(const HostSteps&) = delete;

    /// Returns the path of the socket for a host to listen on.
    std::string socket(const std::string& host) const { return (folder_ / host).string(); }
    /// Runs one cycle. Throws std::runtime_error if the host does not listen, or if the cycle fails (with
    /// the host's message).
    void step(const std::string& host, const std::string& component);

  private:
    std::filesystem::path folder_;                                 ///< contains the sockets
    std::map<std::string, std::unique_ptr<rt::StepClient>> hosts_; ///< each is connected at its first step
};

/// Runs the cycles of both hosts' components one after the other, always in the same order. A tick is the shortest
/// period; a component with a longer period runs in the tick in which its period ends.
class Lockstep {
  public:
    /// Throws std::runtime_error if no component has a period.
    explicit Lockstep(std::vector<SteppedComponent> components);

    /// Returns the path of the socket for a host to listen on.
    std::string socket(const std::string& host) const { return hosts_.socket(host); }
    /// Called after each cycle with the number of the tick, starting at 0.
    using AfterStep = std::function<void(std::uint64_t tick, const SteppedComponent&)>;
    /// Throws std::runtime_error if a host does not listen, or if a cycle fails (with the host's message).
    void run_tick(const AfterStep& after_step = {});
    std::chrono::nanoseconds tick() const { return tick_; }
    std::uint64_t ticks() const { return ticks_; }
    double simulated_s() const;

  private:
    HostSteps hosts_;
    std::vector<SteppedComponent> components_;
    std::chrono::nanoseconds tick_;
    std::uint64_t ticks_ = 0;
};

} // namespace tandem::command
