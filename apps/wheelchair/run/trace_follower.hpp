// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "plugins/wheelchair/core/record/records.hpp"

namespace tandem::wheelchair {

/// Reads a component's trace file while the component writes it. The file may not exist yet, and the component may have
/// been killed. [one thread]
template <class Record>
class TraceFollower {
  public:
    explicit TraceFollower(std::string path) : path_(std::move(path)) {}

    /// Reads the records added since the last call. Throws InputError if the file is not a trace of this record type.
    void update() {
        if (!reader_) {
            if (!trace_exists(path_)) return;
            reader_ = std::make_unique<TraceReader>(path_, column_names<Record>());
        }
        // A record is an array of doubles, in the file as in memory (records.hpp).
        const auto doubles = reader_->read(records_.size(), reader_->size());
        const auto added = doubles.size() / std::size(Record::names);
        const auto had = records_.size();
        records_.resize(had + added);
        if (added > 0)
            std::memcpy(static_cast<void*>(records_.data() + had), doubles.data(), added * sizeof(Record));
    }

    const std::vector<Record>& records() const { return records_; }

  private:
    std::string path_;
    std::unique_ptr<TraceReader> reader_;
    std::vector<Record> records_;
};

/// The traces of the three components of one run.
struct ComponentTraces {
    TraceFollower<HWRecord> hw;
    TraceFollower<JoystickRecord> joystick;
    TraceFollower<ControlRecord> control;

    /// `folder`: RunDirectory::traces().
    explicit ComponentTraces(const std::string& folder)
        : hw(folder + "/HWComp.trace"), joystick(folder + "/JoystickComp.trace"),
          control(folder + "/ControlComp.trace") {}

    void update() {
        hw.update();
        joystick.update();
        control.update();
    }
};

} // namespace tandem::wheelchair
