// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/simulated_device.hpp"

#include <algorithm>
#include <device/BatteryManagementSystem.h>

namespace {

/// `CellCount` cells (6 if not given) in series, full at first and empty after ten hours.
class SimulatedBattery : public tandem::devices::SimulatedDevice<BatteryManagementSystem> {
  public:
    /// Percent.
    int GetChargingRate(double& rate) override {
        return perform([&](double seconds, double) { rate = 100 * charge(seconds); });
    }
    int GetVoltage(double& voltage) override {
        return perform([&](double seconds, double) { voltage = cells_ * cell_voltage(seconds); });
    }
    /// All cells are alike.
    int GetCellVoltage(std::vector<double>& voltages) override {
        return perform([&](double seconds, double) {
            voltages.assign(static_cast<std::size_t>(cells_), cell_voltage(seconds));
        });
    }

  protected:
    void configure() override { cells_ = count_parameter("CellCount", 6); }

  private:
    /// 1 to 0.
    static double charge(double seconds) { return std::max(0.0, 1 - seconds / 36000); }
    /// V: 4.2 when full, 3.3 when empty, as a lithium cell.
    static double cell_voltage(double seconds) { return 3.3 + 0.9 * charge(seconds); }
    int cells_ = 6;
};

} // namespace

TANDEM_DEVICE(BatteryManagementSystem, SimulatedBattery)
