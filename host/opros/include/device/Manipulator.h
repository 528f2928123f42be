// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_MANIPULATOR_H_
#define DEVICE_MANIPULATOR_H_

#include "ServoActuator.h"

/// The name that components use for the profile of a joint.
class ManipulatorProfile : public ServoActuatorProfile {};

/// An arm. Each vector has one value per joint. `time` is how long each joint may take, in milliseconds.
class Manipulator : public Device {
  public:
    Manipulator() {}
    virtual ~Manipulator() {}
    virtual int Stop() { return API_NOT_SUPPORTED; }
    /// Moves the joints to their reference positions.
    virtual int RunHoming() { return API_NOT_SUPPORTED; }
    virtual int SetPower(std::vector<double>, std::vector<unsigned long> /*time*/) {
        return API_NOT_SUPPORTED;
    }
    virtual int GetPower(std::vector<double>&) { return API_NOT_SUPPORTED; }
    virtual int SetVelocity(std::vector<double>, std::vector<unsigned long> /*time*/) {
        return API_NOT_SUPPORTED;
    }
    virtual int GetVelocity(std::vector<double>&) { return API_NOT_SUPPORTED; }
    virtual int SetPosition(std::vector<double>, std::vector<unsigned long> /*time*/) {
        return API_NOT_SUPPORTED;
    }
    virtual int GetPosition(std::vector<double>&) { return API_NOT_SUPPORTED; }
    /// Its name in OPRoS v1.
    virtual int StartHoming() { return RunHoming(); }
    /// OPRoS v1.
    virtual int EmergencyStop() { return Stop(); }
};

#endif
