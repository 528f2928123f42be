// SPDX-License-Identifier: Apache-2.0
// The records of each component per tick, with one column per double in the order of the members. `at` is
// CLOCK_MONOTONIC [s] in all of them, so that traces of different processes are comparable. Other units are those of
// the ports.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "plugins/wheelchair/core/record/trace.hpp"

namespace tandem::wheelchair {

/// Record of JoystickComp.
struct JoystickRecord {
    double at, tick;
    double position_sequence, positions_received, jx, jy, emergency_stop;
    double direction_deg, speed;
    double sent, stamp; // sent: 1 if the reference was sent in this tick
    double core_taken;  // how long others had the core since the last record, see CoreWait
    static constexpr const char* names[] = {"at",
                                            "tick",
                                            "position_sequence",
                                            "positions_received",
                                            "jx",
                                            "jy",
                                            "emergency_stop",
                                            "direction_deg",
                                            "speed",
                                            "sent",
                                            "stamp",
                                            "core_taken"};
};

/// Record of ControlComp.
struct ControlRecord {
    double at, tick, time;
    double reference_sequence, reference_stamp, reference_read_at, references_received;
    double wheel_sequence, wheel_stamp;
    double filtered_direction_deg, state;
    double volts_left, volts_right, brake;
    double core_taken; // as JoystickRecord's, or the longest break in polling if that is longer
    static constexpr const char* names[] = {"at",
                                            "tick",
                                            "time",
                                            "reference_sequence",
                                            "reference_stamp",
                                            "reference_read_at",
                                            "references_received",
                                            "wheel_sequence",
                                            "wheel_stamp",
                                            "filtered_direction_deg",
                                            "state",
                                            "volts_left",
                                            "volts_right",
                                            "brake",
                                            "core_taken"};
};

/// Record of HWComp.
struct HWRecord {
    double at, sequence; // of the publication at the end of the tick
    double applied_at, voltage_sequence, voltage_stamp, voltages_received;
    double volts_left, volts_right, brake, parking_brake, watchdog, link_up; // as applied during the tick
    double jx, jy, emergency_stop; // as published, like all fields below
    double wheel_left_measured, wheel_right_measured, wheel_left, wheel_right;
    double current_left, current_right, x, y, heading, caster_left, caster_right;
    static constexpr const char* names[] = {"at",
                                            "sequence",
                                            "applied_at",
                                            "voltage_sequence",
                                            "voltage_stamp",
                                            "voltages_received",
                                            "volts_left",
                                            "volts_right",
                                            "brake",
                                            "parking_brake",
                                            "watchdog",
                                            "link_up",
                                            "jx",
                                            "jy",
                                            "emergency_stop",
                                            "wheel_left_measured",
                                            "wheel_right_measured",
                                            "wheel_left",
                                            "wheel_right",
                                            "current_left",
                                            "current_right",
                                            "x",
                                            "y",
                                            "heading",
                                            "caster_left",
                                            "caster_right"};
};

/// Returns the column names of a record type for TraceFile and TraceReader.
template <class Record>
ColumnNames column_names() {
    static_assert(sizeof(Record) == std::size(Record::names) * sizeof(double), "one name per double");
    static_assert(std::is_trivially_copyable_v<Record>);
    return Record::names;
}

/// Writes records to a trace file; to none if the path is empty. [one thread]
template <class Record>
class Trace {
  public:
    explicit Trace(const std::string& path)
        : file_(path.empty() ? nullptr : std::make_unique<TraceFile>(path, column_names<Record>())) {}

    // A record's members are doubles without padding, as checked by column_names().
    void append(const Record& record) {
        if (file_) file_->append({reinterpret_cast<const double*>(&record), std::size(Record::names)});
    }

  private:
    std::unique_ptr<TraceFile> file_;
};

} // namespace tandem::wheelchair
