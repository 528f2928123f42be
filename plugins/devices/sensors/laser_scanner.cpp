// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <algorithm>
#include <device/LaserScanner.h>

namespace {

/// Stands in the middle of a square room of 4 m: `ScanPoints` distances from `StartAngle` on, `DeltaAngle`
/// apart; m, rad.
class SimulatedLaserScanner : public tandem::devices::SimulatedSensor<LaserScanner, double> {
  protected:
    void configure() override {
        SimulatedSensor::configure();
        start_ = number("StartAngle", -M_PI / 2);
        delta_ = number("DeltaAngle", M_PI / 180);
    }
    int channels() override { return count("ScanPoints", 181); }
    double at(int channel, double) override {
        const double angle = start_ + channel * delta_;
        return 2 / std::max(std::fabs(std::cos(angle)), std::fabs(std::sin(angle)));
    }

  private:
    double start_ = 0, delta_ = 0;
};

} // namespace

TANDEM_DEVICE(SimulatedLaserScanner)
