// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/plugin/probe.hpp"

#include <future>
#include <map>
#include <mutex>
#include <semaphore>
#include <utility>

namespace tandem::plugin {

/// Probes of several libraries at the same time, at most as many as there are processors: each takes a process of its own
/// and milliseconds, in which a host that starts again is missed. All functions: [any-thread].
class ParallelProbes {
  public:
    /// `task` is the one that serve_probe() performs with each library.
    ParallelProbes(ProbeOptions options, std::string task);

    const ProbeOptions& options() const { return options_; }

    /// Starts to try the library in a thread of its own, unless that has been done.
    void begin(const std::filesystem::path& library, const std::vector<std::string>& arguments = {});
    /// Returns or throws what run_probe() does. A library that was not begun is tried now. The result of a try
    /// is used once: the next call tries again.
    std::string finish(const std::filesystem::path& library, const std::vector<std::string>& arguments = {});

  private:
    using Subject = std::pair<std::filesystem::path, std::vector<std::string>>;
    std::future<std::string> start(const Subject& subject);

    const ProbeOptions options_;
    const std::string task_;
    std::counting_semaphore<> free_processors_;
    std::mutex mutex_;
    std::map<Subject, std::future<std::string>> begun_; ///< their destructors wait for the threads
};

} // namespace tandem::plugin
