// SPDX-License-Identifier: Apache-2.0
#include "apps/wheelchair/run/host_failure.hpp"

namespace tandem::wheelchair {

namespace {

// [s] A reference that arrives within this time after the failure was sent before it, because restarts take longer.
constexpr double in_flight = 0.020;

// Returns the record of the last reference read up to time `until`; null if there is none.
const ControlRecord* last_reference(double until, const std::vector<ControlRecord>& control) {
    for (auto r = control.rbegin(); r != control.rend(); ++r)
        if (r->references_received > 0 && r->reference_read_at <= until) return &*r;
    return nullptr;
}

// Returns the record of the first reference read after time `after`; null if there is none.
const ControlRecord* next_reference(double after, const std::vector<ControlRecord>& control) {
    const ControlRecord* found = nullptr;
    for (auto r = control.rbegin(); r != control.rend() && r->reference_read_at > after; ++r)
        if (r->references_received > 0) found = &*r;
    return found;
}

} // namespace

std::optional<double> motors_off_after_ms(double failed_at, const std::vector<HWRecord>& hw,
                                          const std::vector<ControlRecord>& control) {
    const ControlRecord* last = last_reference(failed_at + in_flight, control);
    if (!last) return {};
    for (const HWRecord& r : hw)
        if (r.applied_at > last->reference_read_at && r.volts_left == 0.0 && r.volts_right == 0.0)
            return (r.applied_at - last->reference_read_at) * 1e3;
    return {};
}

bool HostFailure::update(const std::vector<HWRecord>& hw, const std::vector<ControlRecord>& control) {
    bool found_one = false;
    if (!motors_off_after_ms && !had_hw) {
        motors_off_after_ms = wheelchair::motors_off_after_ms(at, hw, control);
        found_one = motors_off_after_ms.has_value();
    }
    if (!data_back_after_ms) {
        if (const ControlRecord* back = next_reference(at + in_flight, control)) {
            data_back_after_ms = (back->reference_read_at - (restarted_at > 0.0 ? restarted_at : at)) * 1e3;
            found_one = true;
        }
    }
    return found_one;
}

} // namespace tandem::wheelchair
