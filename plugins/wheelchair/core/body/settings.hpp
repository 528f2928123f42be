// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "plugins/wheelchair/core/record/scenario.hpp"

namespace tandem::wheelchair {

/// Parameters as texts, as profiles and rtc.conf give them; empty means default. Each component reads those
/// it has.
struct RawSettings {
    std::string scenario{};      // name, default step20
    std::string joystick_file{}; // CSV with stick positions, default none
    std::string clock{};         // monotonic (default) | simulated
    std::string poll_us{};       // how long ControlComp looks out for a new reference in a tick, default 0
    std::string trace{};         // file to record in, default none
};

struct Settings {
    Scenario scenario;
    bool simulated = false;
    double poll_seconds = 0.0;
    std::string trace;
};

/// Throws InputError that names the parameter and what it may be.
Settings read_settings(const RawSettings& texts);

} // namespace tandem::wheelchair
