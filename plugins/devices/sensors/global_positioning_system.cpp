// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/GlobalPositioningSystem.h>

namespace {

/// Walks round a circle of a metre; degrees, m/s.
class SimulatedGlobalPositioningSystem
    : public tandem::devices::SimulatedSensor<GlobalPositioningSystem, GpsData> {
    GpsData at(int channel, double seconds) override {
        static_cast<void>(channel);
        GpsData data;
        data.latitude = 37.29 + 1e-5 * std::sin(0.2 * M_PI * seconds);
        data.longitude = 126.83 + 1e-5 * std::cos(0.2 * M_PI * seconds);
        data.velocity = 0.7;
        data.time = std::to_string(static_cast<long>(seconds));
        return data;
    }
};

} // namespace

TANDEM_DEVICE(SimulatedGlobalPositioningSystem)
