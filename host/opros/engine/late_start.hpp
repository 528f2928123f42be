// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/application_directory.hpp"

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace tandem::engine {

/// Starts components again whose start has failed because a service of another node was not there yet. Each one is tried
/// until it starts once, in intervals that grow: a later error is the component's own. [main-thread]
class LateStart {
  public:
    /// `directory` must outlive this object. Throws process::NotStarted.
    LateStart(ApplicationDirectory& directory, std::vector<std::string> components);
    /// Waits for the current attempt.
    ~LateStart();
    LateStart(const LateStart&) = delete;
    LateStart& operator=(const LateStart&) = delete;

  private:
    void run();

    ApplicationDirectory& directory_;
    std::vector<std::string> components_; ///< that have not started yet; used by the thread
    std::mutex mutex_;
    std::condition_variable wake_;
    bool stopping_ = false; ///< under mutex_
    std::thread thread_;
};

} // namespace tandem::engine
