// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_BATTERYMANAGEMENTSYSTEM_H_
#define DEVICE_BATTERYMANAGEMENTSYSTEM_H_

#include "Sensor.h"

/// The state of a battery: charge in per cent, voltages in volts.
class BatteryManagementSystem : public Sensor {
  public:
    BatteryManagementSystem() {}
    virtual ~BatteryManagementSystem() {}
    virtual int GetChargingRate(double&) { return API_NOT_SUPPORTED; }
    virtual int GetVoltage(double&) { return API_NOT_SUPPORTED; }
    virtual int GetCellVoltage(std::vector<double>&) { return API_NOT_SUPPORTED; }
    /// Its name in OPRoS v1.
    virtual int GetBatteryVoltage(double& voltage) { return GetVoltage(voltage); }
};

#endif
