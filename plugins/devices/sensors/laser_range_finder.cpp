// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"
#include "plugins/devices/sensors/square_room.hpp"

#include <device/LaserRangeFinder.h>

namespace {

/// Has `Size` scanners in the middle of a square room. Each returns `ScanPoints` distances, starting at `StartAngle` in
/// steps of `DeltaAngle`; m, rad.
class SimulatedLaserRangeFinder
    : public tandem::devices::SimulatedSensor<LaserRangeFinder, OPRoS::Float64Array> {
  protected:
    void configure() override {
        SimulatedSensor::configure();
        const double start = number_parameter("StartAngle", -M_PI / 2);
        const double delta = number_parameter("DeltaAngle", M_PI / 180);
        scan_.data.clear();
        for (int i = 0; i < count_parameter("ScanPoints", 181); ++i)
            scan_.data.push_back(tandem::devices::distance_in_square_room(start + i * delta));
    }
    OPRoS::Float64Array value_at(int, double) override { return scan_; }

  private:
    OPRoS::Float64Array scan_;
};

} // namespace

TANDEM_DEVICE(LaserRangeFinder, SimulatedLaserRangeFinder)
