// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/plugin/parallel_probes.hpp"
#include "host/plugin/probe_child.hpp"
#include <rtm/SystemLogger.h>

namespace RTC {

/// Name of the probe task that run_module_probe() carries out (host/plugin/probe.hpp).
constexpr char module_probe_task[] = "load-rtm";

/// In the host: tries modules in child processes, which perform run_module_probe(). [any-thread]
class ModuleProbes {
  public:
    explicit ModuleProbes(const tandem::plugin::ProbeOptions& options);
    /// Starts to try the module, while the host continues.
    void begin(const std::string& library, const std::string& init);
    /// Waits for the end of the trial. Logs a warning for a destructor that does not return. Throws
    /// tandem::plugin::Error for a crash, a hang or any other failure.
    void finish(const std::string& library, const std::string& init, Logger& rtclog);

  private:
    std::vector<std::string> arguments(const std::string& init) const;
    tandem::plugin::ParallelProbes probes_;
};

/// In the child process: loads the module, creates and deletes one component of each type that it registers,
/// without initializing it. Arguments of the task: the init function, and the milliseconds that a destructor
/// may take. Throws ManagerError or tandem::plugin::Error; reports the type whose destructor hangs.
void run_module_probe(const tandem::plugin::ProbeTask& task, tandem::plugin::ProbeReport& report);

} // namespace RTC
