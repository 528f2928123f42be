// SPDX-License-Identifier: Apache-2.0
// A stick that a person moves: a small file in shared memory, written by the program that has the gamepad and read by
// HWComp in each tick, without a system call. Layout, in native byte order: see LiveStickFile.
#pragma once

#include <atomic>
#include <boost/interprocess/mapped_region.hpp>
#include <cstdint>
#include <string>

#include "plugins/wheelchair/core/law/signals.hpp"

namespace tandem::wheelchair {

/// The file. The writer makes `version` odd before it changes the rest, and even after.
struct LiveStickFile {
    char magic[8];
    std::atomic<std::uint64_t> version;
    std::atomic<double> x, y, emergency_stop;
    std::atomic<std::int64_t> time_ns; ///< CLOCK_MONOTONIC of the last write
};
static_assert(sizeof(LiveStickFile) == 48);

/// A position that is older counts as a released stick: its writer, or whoever moves it, is gone.
inline constexpr std::int64_t stick_silence_ns = 200'000'000;

/// The mapped file, for its writer or a reader. One writer; readers in any process. [any-thread]
class LiveStick {
  public:
    enum class Role { writer, reader };
    /// The writer creates the file. Throws InputError if it cannot be created, or is no such file.
    LiveStick(const std::string& path, Role role);
    LiveStick(const LiveStick&) = delete;
    LiveStick& operator=(const LiveStick&) = delete;

    void write(const JoystickPosition& position);
    /// Released if nobody has written for 200 ms or what was written is no position. Whole counts from -2000 to 2000.
    JoystickPosition read() const;

  private:
    boost::interprocess::mapped_region region_;
    LiveStickFile* file_;
};

/// Whether the file is a live stick, and not a recorded one.
bool is_live_stick(const std::string& path);

} // namespace tandem::wheelchair
