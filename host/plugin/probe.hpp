// SPDX-License-Identifier: Apache-2.0
// Tries a library in a child process before it is loaded into this one: if its code crashes, hangs or calls
// exit(), this process goes on and can say why the library was not loaded.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace tandem::plugin {

/// How run_probe() tries a library.
struct ProbeOptions {
    /// Program whose main() calls serve_probe() (probe_child.hpp): by default this program itself.
    std::filesystem::path program = "/proc/self/exe";
    std::chrono::milliseconds timeout{10'000}; ///< for the whole task; then the child is killed
    std::string subject = "library";           ///< what the file is, for messages
};

/// Starts the program in a child process, where serve_probe() performs the named task with the library and
/// the arguments. Returns what the task passed to ProbeReport::finish(). Throws Error probe_failed when the
/// child crashes, hangs, exits or reports an exception: one line that names the function in which it
/// happened. [any-thread]
std::string run_probe(const ProbeOptions& options, const std::string& task,
                      const std::filesystem::path& library, const std::vector<std::string>& arguments = {});

} // namespace tandem::plugin
