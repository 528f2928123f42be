// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"
#include "plugins/devices/sensors/square_room.hpp"

#include <device/LaserScanner.h>

namespace {

/// Is in the middle of a square room with sides of 4 m. Returns `ScanPoints` distances, starting at `StartAngle` in
/// steps of `DeltaAngle`; m, rad.
class SimulatedLaserScanner : public tandem::devices::SimulatedSensor<LaserScanner, double> {
  protected:
    void configure() override {
        SimulatedSensor::configure();
        start_angle_ = number_parameter("StartAngle", -M_PI / 2);
        delta_angle_ = number_parameter("DeltaAngle", M_PI / 180);
    }
    int configured_channels() override { return count_parameter("ScanPoints", 181); }
    double value_at(int channel, double) override {
        return tandem::devices::distance_in_square_room(start_angle_ + channel * delta_angle_);
    }

  private:
    double start_angle_ = 0, delta_angle_ = 0;
};

} // namespace

TANDEM_DEVICE(LaserScanner, SimulatedLaserScanner)
