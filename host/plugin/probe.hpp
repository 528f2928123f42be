// SPDX-License-Identifier: Apache-2.0
// A library is tried in a child process first: whatever it does there, this process lives on and can say why
// it was not loaded.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace tandem::plugin {

struct ProbeOptions {
    /// Program whose main() hands over to a ProbedSide (probe_child.hpp): as a rule this program itself.
    std::filesystem::path program = "/proc/self/exe";
    std::chrono::milliseconds timeout{10'000};
    std::string subject = "library"; ///< what the file is, for messages
};

/// Tries the library with what the program does when it is probed; `task` and the arguments are told to it.
/// What it has reported. Throws Error probe_failed: crash, hang, exit, exception, each in one line with the
/// function in which it happened. [any-thread]
std::string run_probe(const ProbeOptions& options, const std::string& task,
                      const std::filesystem::path& library, const std::vector<std::string>& arguments = {});

} // namespace tandem::plugin
