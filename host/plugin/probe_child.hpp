// SPDX-License-Identifier: Apache-2.0
// The child's side of a probe.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace tandem::plugin {

/// What a probed process tells its parent.
class ProbeReport {
  public:
    /// Code of the library runs from now on, in this function ("getComponent()"): named if the process does
    /// not survive it.
    void begin_stage(const std::string& function);
    /// The parent's probe() returns this text. Ends the process: nothing of the library is released or unloaded.
    [[noreturn]] void finish(const std::string& result);
};

struct ProbeTask {
    std::string library;
    std::vector<std::string> arguments;
};

/// What a program does when it is probed, by the task's name. An exception is the reason why the library is
/// refused.
using ProbeTasks = std::map<std::string, std::function<void(const ProbeTask&, ProbeReport&)>>;

/// To be called first in main(): when the process has been started by probe(), does the task and ends the
/// process; otherwise returns at once.
void serve_probe(int argc, char** argv, const ProbeTasks& tasks);

} // namespace tandem::plugin
