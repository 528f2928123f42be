// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_MOBILECONTROLLER_H_
#define DEVICE_MOBILECONTROLLER_H_

#include "Device.h"
#include "MobilePositionData.h"
#include "MobileVelocityData.h"

/// A mobile base. OPRoS v2; v1.1 has WheelController.
class MobileController : public Device {
  public:
    MobileController() {}
    virtual ~MobileController() {}
    /// Returns the pulses of the wheels.
    virtual std::int32_t GetOdometry(std::vector<OPRoS::Int32>&) { return API_NOT_SUPPORTED; }
    virtual std::int32_t SetVelocity(OPRoS::MobileVelocityData) { return API_NOT_SUPPORTED; }
    virtual std::int32_t SetPosition(OPRoS::MobilePositionData) { return API_NOT_SUPPORTED; }
    virtual std::int32_t GetPosition(OPRoS::MobilePositionData&) { return API_NOT_SUPPORTED; }
};

#endif
