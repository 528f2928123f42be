// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "plugins/wheelchair/core/plant/parameters.hpp"
#include "plugins/wheelchair/core/record/records.hpp"

namespace tandem::wheelchair {

/// How much of a trace a follower keeps.
struct TraceLimit {
    /// Keeps at least this number of the newest records, and at most twice as many; 0: all.
    std::size_t records = 0;
    bool discard_files = false; ///< also frees the room of the others in the file
};

/// A run of hours must not grow: of a run in real time that is longer than 12 minutes, the last 6 to 12 minutes are kept.
inline TraceLimit limit_of_run(double seconds, bool keeps_files) {
    constexpr std::size_t ticks = 36'000;
    return seconds > 2 * ticks * tick_seconds ? TraceLimit{ticks, !keeps_files} : TraceLimit{};
}

/// Reads a component's trace file while the component writes it. The file may not exist yet, and the component may have
/// been killed. [one thread]
template <class Record>
class TraceFollower {
  public:
    explicit TraceFollower(std::string path, TraceLimit limit = {}) : path_(std::move(path)), limit_(limit) {}

    /// Reads the records added since the last call. Throws InputError if the file is not a trace of this record type.
    void update() {
        if (!reader_) {
            if (!trace_exists(path_)) return;
            reader_ = std::make_unique<TraceReader>(path_, column_names<Record>());
        }
        // A record is an array of doubles, in the file as in memory (records.hpp).
        const auto doubles = reader_->read(dropped_ + records_.size(), reader_->size());
        const auto added = doubles.size() / std::size(Record::names);
        const auto had = records_.size();
        records_.resize(had + added);
        if (added > 0)
            std::memcpy(static_cast<void*>(records_.data() + had), doubles.data(), added * sizeof(Record));
        if (limit_.records > 0 && records_.size() > 2 * limit_.records)
            drop(records_.size() - limit_.records);
    }

    /// Returns the kept records, oldest first.
    const std::vector<Record>& records() const { return records_; }
    /// Returns the number of older records that are no longer kept.
    std::size_t dropped() const { return dropped_; }

  private:
    void drop(std::size_t count) {
        records_.erase(records_.begin(), records_.begin() + static_cast<std::ptrdiff_t>(count));
        dropped_ += count;
        if (limit_.discard_files) discard_records(path_, column_names<Record>(), dropped_);
    }

    std::string path_;
    TraceLimit limit_;
    std::unique_ptr<TraceReader> reader_;
    std::vector<Record> records_;
    std::size_t dropped_ = 0;
};

/// The traces of the three components of one run.
struct ComponentTraces {
    TraceFollower<HWRecord> hw;
    TraceFollower<JoystickRecord> joystick;
    TraceFollower<ControlRecord> control;

    /// `folder`: RunDirectory::traces(). `limit`: that of HWComp. More records are kept of the others, because each kept
    /// record needs its counterparts in the traces that it depends on.
    explicit ComponentTraces(const std::string& folder, TraceLimit limit = {})
        : hw(folder + "/HWComp.trace", limit),
          joystick(folder + "/JoystickComp.trace", {4 * limit.records, limit.discard_files}),
          control(folder + "/ControlComp.trace", {2 * limit.records, limit.discard_files}) {}

    void update() {
        hw.update();
        joystick.update();
        control.update();
    }
};

} // namespace tandem::wheelchair
