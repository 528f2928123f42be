// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/plugin/probe.hpp"

#include <future>
#include <map>
#include <mutex>
#include <semaphore>
#include <utility>

namespace tandem::plugin {

/// Probes several libraries in parallel, at most as many as there are processors. Each probe takes a process and some
/// milliseconds, which would otherwise delay the restart of a host. All functions: [any-thread].
class ParallelProbes {
  public:
    /// `task` is the task that serve_probe() performs with each library.
    ParallelProbes(ProbeOptions options, std::string task);

    const ProbeOptions& options() const { return options_; }

    /// Starts to probe the library in a separate thread, unless the probe has already been started.
    void begin(const std::filesystem::path& library, const std::vector<std::string>& arguments = {});
    /// Returns or throws the result of run_probe(). Probes the library now if begin() was not called for it. Each result is used
    /// once: the next call probes again.
    std::string finish(const std::filesystem::path& library, const std::vector<std::string>& arguments = {});

  private:
    using Subject = std::pair<std::filesystem::path, std::vector<std::string>>;
    std::future<std::string> start(const Subject& subject);

    const ProbeOptions options_;
    const std::string task_;
    std::counting_semaphore<> free_processors_;
    std::mutex mutex_;
    std::map<Subject, std::future<std::string>> begun_; ///< the destructors wait for the threads
};

} // namespace tandem::plugin
