// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/simulated_device.hpp"

#include <algorithm>
#include <device/BatteryManagementSystem.h>

namespace {

/// `CellCount` cells that are full at first and empty after ten hours.
class SimulatedBattery : public tandem::devices::SimulatedDevice<BatteryManagementSystem> {
  public:
    int GetChargingRate(double& rate) override {
        return serve([&](double seconds, double) { rate = 100 * charge(seconds); });
    }
    int GetVoltage(double& voltage) override {
        return serve([&](double seconds, double) { voltage = cells_ * cell(seconds); });
    }
    int GetCellVoltage(std::vector<double>& voltages) override {
        return serve([&](double seconds, double) {
            voltages.assign(static_cast<std::size_t>(cells_), cell(seconds));
        });
    }

  protected:
    void configure() override { cells_ = count("CellCount", 6); }

  private:
    static double charge(double seconds) { return std::max(0.0, 1 - seconds / 36000); }
    static double cell(double seconds) { return 3.3 + 0.9 * charge(seconds); }
    int cells_ = 6;
};

} // namespace

TANDEM_DEVICE(SimulatedBattery)
