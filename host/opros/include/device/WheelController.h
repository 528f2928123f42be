// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_WHEELCONTROLLER_H_
#define DEVICE_WHEELCONTROLLER_H_

#include "Device.h"

/// Dimensions and limits of the base, for components that store them.
class WheelControllerProfile {
  public:
    WheelControllerProfile()
        : wheelDiameter(0), axleDistance(0), varianceDistance(0), varianceDirection(0), safeRadius(0),
          maximumVelocity(0), acceleration(0) {}
    virtual ~WheelControllerProfile() {}
    double wheelDiameter, axleDistance, varianceDistance, varianceDirection;
    double safeRadius, maximumVelocity, acceleration;
};

/// A base with two driven wheels, in m and rad. DriveWheel() sets velocities. MoveWheel() and RotateWheel() begin a
/// motion; IsWheelRunning() shows when it ends.
class WheelController : public Device {
  public:
    WheelController() {}
    virtual ~WheelController() {}
    /// Sets the current position, from which GetPosition() continues.
    virtual int SetPosition(ObjectLocation) { return API_NOT_SUPPORTED; }
    virtual int GetPosition(ObjectLocation&) { return API_NOT_SUPPORTED; }
    /// Returns the pulses of the two wheels. The spelling is upstream's.
    virtual int GetOdometery(std::vector<long>&) { return API_NOT_SUPPORTED; }
    virtual int DriveWheel(double /*linearVelocity*/, double /*angularVelocity*/) {
        return API_NOT_SUPPORTED;
    }
    virtual int MoveWheel(double /*distance*/, double /*linearVelocity*/) { return API_NOT_SUPPORTED; }
    virtual int RotateWheel(double /*angle*/, double /*angularVelocity*/) { return API_NOT_SUPPORTED; }
    virtual int StopWheel() { return API_NOT_SUPPORTED; }
    virtual int IsWheelRunning(bool&) { return API_NOT_SUPPORTED; }

    // Their names in OPRoS v1.
    virtual int Stop() { return StopWheel(); }
    virtual int EmergencyStop() { return StopWheel(); }
    virtual int Drive(double linearVelocity, double angularVelocity) {
        return DriveWheel(linearVelocity, angularVelocity);
    }
    virtual int Move(double /*distance*/) { return API_NOT_SUPPORTED; }
    virtual int Rotate(double /*angle*/) { return API_NOT_SUPPORTED; }
};

#endif
