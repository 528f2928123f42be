// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/simulated_device.hpp"

#include <device/GPS.h>

namespace {

/// Walks round a circle of a metre; degrees, m/s.
class SimulatedGPS : public tandem::devices::SimulatedDevice<GPS> {
  public:
    int GetGPSData(GPSData& data) override {
        return serve([&](double seconds, double) {
            data.latitude = 37.29 + 1e-5 * std::sin(0.2 * M_PI * seconds);
            data.longitude = 126.83 + 1e-5 * std::cos(0.2 * M_PI * seconds);
            data.velocity = 0.7;
            data.time = std::to_string(static_cast<long>(seconds));
        });
    }
};

} // namespace

TANDEM_DEVICE(SimulatedGPS)
