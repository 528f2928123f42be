// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <sys/types.h>
#include <vector>

namespace tandem::wheelchair {

/// Implements --record. It is in a library that is loaded on demand, because writing recordings takes as long to
/// compile as the rest of this program, and a first run should not wait for it.
class StepRecording {
  public:
    virtual ~StepRecording() = default;

    /// Call this when all hosts are ready. `tick`: length of a tick.
    virtual void begin(const std::vector<pid_t>& hosts, std::chrono::nanoseconds tick) = 0;
    /// Call this after the component's cycle in that tick, counted from 0.
    virtual void record_step(std::uint64_t tick, const std::string& host, const std::string& component) = 0;
    /// Ends the file. Returns a one-line summary.
    virtual std::string close() = 0;
};

/// Creates the file. Call this before the hosts start. Throws std::runtime_error, for example if the library is missing.
std::unique_ptr<StepRecording> open_step_recording(const std::string& file);

/// The library's only function and its name.
using MakeStepRecording = StepRecording*(const std::string& file);
inline constexpr const char* make_step_recording_name = "tandem_make_step_recording";

} // namespace tandem::wheelchair
