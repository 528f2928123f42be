// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "plugins/wheelchair/core/record/records.hpp"

namespace tandem::wheelchair {

/// A component's trace, followed while it grows. Works before the component exists and after it was killed.
template <class Record>
class TraceFollower {
  public:
    explicit TraceFollower(std::string path) : path_(std::move(path)) {}

    /// Reads what has come since the last call. Throws InputError when the file is no trace.
    void update() {
        if (!reader_) {
            if (!trace_exists(path_)) return;
            reader_ = std::make_unique<TraceReader>(path_, column_names<Record>());
        }
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

struct ComponentTraces {
    TraceFollower<HWRecord> hw;
    TraceFollower<JoystickRecord> joystick;
    TraceFollower<ControlRecord> control;

    /// `folder`: where the run directory has its traces.
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
