// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/mcap/writer.hpp"

#include <cstdint>
#include <functional>

namespace tandem::command {

/// CLOCK_REALTIME and CLOCK_MONOTONIC at one moment, in ns.
struct ClockReading {
    std::uint64_t wall_ns = 0, monotonic_ns = 0;
};
/// Reads both clocks. Repeats the reading if the thread was interrupted between them.
ClockReading read_clocks();

/// The log times of a recording: its start by the wall clock, plus the time of CLOCK_MONOTONIC since then. Setting the
/// wall clock changes neither their order nor their distances. [any-thread, except take_step()]
class RecordingClock {
  public:
    using Read = std::function<ClockReading()>;
    explicit RecordingClock(Read read = read_clocks) : read_(std::move(read)), start_(read_()) {}

    /// Returns the log time of a value of CLOCK_MONOTONIC, which may be before the start.
    std::uint64_t time_of(std::uint64_t monotonic_ns) const {
        return start_.wall_ns + (monotonic_ns - start_.monotonic_ns);
    }
    std::uint64_t now() const;
    const ClockReading& reading_at_start() const { return start_; }

    /// Returns by how many ns the wall clock was set forward (back: negative) since the last call; 0 if by less than a
    /// millisecond.
    std::int64_t take_step();
    /// Returns wall clock minus log time in ns: the sum of all steps.
    std::int64_t offset_ns() const { return offset_ns_; }

  private:
    const Read read_;
    const ClockReading start_;
    std::int64_t offset_ns_ = 0;
};

/// Writes how the log times of a recording relate to the wall clock: metadata `tandem.clock` with both clocks at the
/// start, and a message of type `tandem::ClockStep` on `/tandem/clock` for each step. [one thread]
class ClockChannel {
  public:
    /// Both must outlive this object.
    ClockChannel(mcap::McapWriter& writer, RecordingClock& clock) : writer_(writer), clock_(clock) {}
    /// Writes the metadata at the first call. Throws mcap::Error.
    void write_start();
    /// Writes a message if the wall clock was set since the last call. Throws mcap::Error.
    void write_step();
    std::uint32_t steps() const { return steps_; }

  private:
    mcap::McapWriter& writer_;
    RecordingClock& clock_;
    bool started_ = false;
    std::uint16_t channel_ = 0;
    std::uint32_t steps_ = 0;
};

} // namespace tandem::command
