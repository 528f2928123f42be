// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/simulated_device.hpp"

#include <algorithm>
#include <device/BatteryManagementSystem.h>

namespace {

/// `CellCount` cells (default 6) in series. They are full at first, and empty after ten hours.
class SimulatedBattery : public tandem::devices::SimulatedDevice<BatteryManagementSystem> {
  public:
    /// Returns the charge in percent.
    int GetChargingRate(double& rate) override {
        return perform([&](double seconds, double) { rate = 100 * charge(seconds); });
    }
    int GetVoltage(double& voltage) override {
        return perform([&](double seconds, double) { voltage = cells_ * cell_voltage(seconds); });
    }
    /// All cells are equal.
    int GetCellVoltage(std::vector<double>& voltages) override {
        return perform([&](double seconds, double) {
            voltages.assign(static_cast<std::size_t>(cells_), cell_voltage(seconds));
        });
    }

  protected:
    void configure() override { cells_ = count_parameter("CellCount", 6); }

  private:
    /// Returns the charge from 1 to 0.
    static double charge(double seconds) { return std::max(0.0, 1 - seconds / 36000); }
    /// Returns V: 4.2 when full, 3.3 when empty, like a lithium cell.
    static double cell_voltage(double seconds) { return 3.3 + 0.9 * charge(seconds); }
    int cells_ = 6;
};

} // namespace

TANDEM_DEVICE(BatteryManagementSystem, SimulatedBattery)
