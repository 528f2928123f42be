// SPDX-License-Identifier: Apache-2.0
// Probes a library in a child process before it is loaded into this one. If the library's code crashes, hangs or
// calls exit(), this process continues and can report why the library was not loaded.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace tandem::plugin {

/// How run_probe() probes a library.
struct ProbeOptions {
    /// A program whose main() calls serve_probe() (probe_child.hpp); by default this program.
    std::filesystem::path program = "/proc/self/exe";
    std::chrono::milliseconds timeout{10'000}; ///< for the whole task; afterwards the child is killed
    std::string subject = "library";           ///< the kind of file, for messages
};

/// Starts the program as a child process, in which serve_probe() performs the named task with the library and the
/// arguments. Returns the text that the task passed to ProbeReport::finish(). Throws Error probe_failed, one line
/// with the function at fault, if the child crashes, hangs, exits or reports an exception. [any-thread]
std::string run_probe(const ProbeOptions& options, const std::string& task,
                      const std::filesystem::path& library, const std::vector<std::string>& arguments = {});

} // namespace tandem::plugin
