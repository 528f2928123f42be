// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_walk.hpp"
#include "plugins/devices/simulated_device.hpp"

#include <device/GPS.h>

namespace {

/// The receiver of OPRoS v1.
class SimulatedGPS : public tandem::devices::SimulatedDevice<GPS> {
  public:
    int GetGPSData(GPSData& data) override {
        return perform(
            [&](double seconds, double) { data = tandem::devices::walk_on_circle<GPSData>(seconds); });
    }
};

} // namespace

TANDEM_DEVICE(Gps, SimulatedGPS)
