// SPDX-License-Identifier: Apache-2.0
// A stick that a person moves: a small file in shared memory. The program with the gamepad writes it, and HWComp reads
// it in each tick without a system call. LiveStickFile defines the layout, in native byte order.
#pragma once

#include <atomic>
#include <boost/interprocess/mapped_region.hpp>
#include <cstdint>
#include <string>

#include "plugins/wheelchair/core/law/signals.hpp"

namespace tandem::wheelchair {

/// The file. The writer makes `version` odd before it changes the other fields, and even afterwards.
struct LiveStickFile {
    char magic[8];
    std::atomic<std::uint64_t> version;
    std::atomic<double> x, y, emergency_stop;
    std::atomic<std::int64_t> time_ns; ///< CLOCK_MONOTONIC of the last write
};
static_assert(sizeof(LiveStickFile) == 48);

/// An older position counts as a released stick, because its writer or driver is gone.
inline constexpr std::int64_t stick_silence_ns = 200'000'000;

/// The mapped file, for one writer, or for readers in any process. [any-thread]
class LiveStick {
  public:
    enum class Role { writer, reader };
    /// The writer creates the file. Throws InputError if it cannot be created or is not a live stick file.
    LiveStick(const std::string& path, Role role);
    LiveStick(const LiveStick&) = delete;
    LiveStick& operator=(const LiveStick&) = delete;

    void write(const JoystickPosition& position);
    /// Returns whole counts from -2000 to 2000; released if nothing was written for 200 ms or the values are invalid.
    JoystickPosition read() const;

  private:
    boost::interprocess::mapped_region region_;
    LiveStickFile* file_;
};

/// Returns whether the file is a live stick instead of a recorded one.
bool is_live_stick(const std::string& path);

} // namespace tandem::wheelchair
