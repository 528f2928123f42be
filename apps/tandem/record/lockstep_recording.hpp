// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/file_sink.hpp"
#include "apps/tandem/record/recorder.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <sys/types.h>
#include <vector>

namespace tandem::command {

/// Records a lock-step run in the program that drives it. Whoever drives knows which component's cycle has sent a message,
/// so that the recording says it, its times are those of the simulation, and a replay can do the same again. [one thread]
class LockstepRecording {
  public:
    /// Makes the file. Throws mcap::Error.
    explicit LockstepRecording(const std::string& file);
    ~LockstepRecording(); ///< Without close() the file is as that of a killed recorder.

    /// Call it before the hosts are started: what they inherit lets their service calls be recorded.
    static void prepare_environment();

    /// Before the first cycle, when all hosts are ready: records the links between them, with what they have sent so far.
    /// `tick`: the length of a tick.
    void begin(const std::vector<pid_t>& hosts, std::chrono::nanoseconds tick);
    /// After the component's cycle in that tick, counted from 0.
    void record_step(std::uint64_t tick, const std::string& host, const std::string& component);
    /// Throws mcap::Error.
    void close();

    std::string summary() const; ///< one line

  private:
    const std::string name_;
    mcap::FileSink file_;
    mcap::McapWriter writer_;
    std::unique_ptr<Recorder> recorder_;
    std::chrono::nanoseconds tick_{};
};

} // namespace tandem::command
