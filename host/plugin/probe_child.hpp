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
    /// To be called before each call into the library, with the function's name ("getComponent()"): the
    /// parent names this function if the child ends in it.
    void begin_stage(const std::string& function);
    /// Makes the parent's run_probe() return this text. Ends the process at once; destructors of the library
    /// do not run.
    [[noreturn]] void finish(const std::string& result);
};

/// Arguments of a task.
struct ProbeTask {
    std::string library;
    std::vector<std::string> arguments;
};

/// The tasks that a program can perform in a child process, by name. What a task throws is reported to the
/// parent as the reason why the library is refused.
using ProbeTasks = std::map<std::string, std::function<void(const ProbeTask&, ProbeReport&)>>;

/// To be called first in main(). In a process that run_probe() has started, performs the task and ends the
/// process; in any other returns at once. [main-thread]
void serve_probe(int argc, char** argv, const ProbeTasks& tasks);

} // namespace tandem::plugin
