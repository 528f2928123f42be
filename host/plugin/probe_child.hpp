// SPDX-License-Identifier: Apache-2.0
// The child process of run_probe() (probe.hpp).
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace tandem::plugin {

/// Reports from the child process to the parent's run_probe().
class ProbeReport {
  public:
    /// Names the function of the library that is called next ("getComponent()"). Call it before each call into the
    /// library: the parent names this function if the child ends in it.
    void begin_stage(const std::string& function);
    /// Makes the parent's run_probe() return this text. Ends the process at once, without running the library's
    /// destructors.
    [[noreturn]] void finish(const std::string& result);
};

/// Arguments of a task.
struct ProbeTask {
    std::string library;
    std::vector<std::string> arguments;
};

/// The tasks that a program can perform in a child process, by name. An exception of a task is reported to the parent
/// as the reason for refusing the library.
using ProbeTasks = std::map<std::string, std::function<void(const ProbeTask&, ProbeReport&)>>;

/// Must be the first call in main(). In a process started by run_probe(), performs the task and ends the process.
/// Otherwise returns at once. [main-thread]
void serve_probe(int argc, char** argv, const ProbeTasks& tasks);

} // namespace tandem::plugin
