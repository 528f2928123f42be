// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <sys/types.h>
#include <vector>

namespace tandem::wheelchair {

/// What --record does. It lies in a library of its own, loaded when it is asked for: what writes recordings takes about
/// as long to compile as the rest of this program, and a first run need not wait for it.
class StepRecording {
  public:
    virtual ~StepRecording() = default;

    /// When all hosts are ready. `tick`: the length of a tick.
    virtual void begin(const std::vector<pid_t>& hosts, std::chrono::nanoseconds tick) = 0;
    /// After the component's cycle in that tick, counted from 0.
    virtual void record_step(std::uint64_t tick, const std::string& host, const std::string& component) = 0;
    /// Ends the file. Returns one line that sums it up.
    virtual std::string close() = 0;
};

/// Makes the file; to be called before the hosts are started. Throws std::runtime_error, also if the library is not
/// there.
std::unique_ptr<StepRecording> open_step_recording(const std::string& file);

/// The library's only function, by this name.
using MakeStepRecording = StepRecording*(const std::string& file);
inline constexpr const char* make_step_recording_name = "tandem_make_step_recording";

} // namespace tandem::wheelchair
