// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/record/recorder.hpp"
#include "apps/tandem/record/recording_output.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <sys/types.h>
#include <vector>

namespace tandem::command {

/// Records a lock-step run in the program that drives it. The driver knows which component's cycle sent a
/// message. The recording stores that and simulated times, so that a replay can repeat the run. [one
/// thread]
class LockstepRecording {
  public:
    /// Creates the file. Throws mcap::Error.
    explicit LockstepRecording(const std::string& file);
    ~LockstepRecording(); ///< Without close(), closes the file without errors.

    /// Call this before the hosts start: they inherit a setting that keeps their service calls readable.
    static void prepare_environment();

    /// Starts recording the links between the hosts, including messages sent so far. Call this when all
    /// hosts are ready, before the first cycle. `tick`: the length of a tick.
    void begin(const std::vector<pid_t>& hosts, std::chrono::nanoseconds tick);
    /// Records the component's cycle in that tick, counted from 0. Call this after the cycle.
    void record_step(std::uint64_t tick, const std::string& host, const std::string& component);
    /// Throws mcap::Error. After an error of record_step(), closes the file as far as possible and says what is lost.
    void close();

    std::string summary() const; ///< one line

  private:
    RecordingOutput output_;
    std::unique_ptr<Recorder> recorder_;
    std::chrono::nanoseconds tick_{};
};

} // namespace tandem::command
