// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_MANIPULATOR_H_
#define DEVICE_MANIPULATOR_H_

#include "ServoActuator.h"

#include <initializer_list>

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

    // OPRoS v2. Velocities and torques are reached at once.
    virtual std::int32_t SetTorque(std::vector<OPRoS::Float64> torque) {
        return SetPower(opros::detail::numbers_in<double>(torque), std::vector<unsigned long>(torque.size()));
    }
    virtual std::int32_t GetTorque(std::vector<OPRoS::Float64>& torque) {
        return opros::detail::get_numbers(*this, &Manipulator::GetPower, torque);
    }
    virtual std::int32_t SetVelocity(std::vector<OPRoS::Float64> velocity) {
        return SetVelocity(opros::detail::numbers_in<double>(velocity),
                           std::vector<unsigned long>(velocity.size()));
    }
    virtual std::int32_t GetVelocity(std::vector<OPRoS::Float64>& velocity) {
        return opros::detail::get_numbers(*this, &Manipulator::GetVelocity, velocity);
    }
    virtual std::int32_t SetPosition(std::vector<OPRoS::Float64> position, std::vector<OPRoS::UInt32> time) {
        return SetPosition(opros::detail::numbers_in<double>(position),
                           opros::detail::numbers_in<unsigned long>(time));
    }
    /// For two lists in braces, which fit both versions. Ours.
    int SetPosition(std::initializer_list<double> position, std::initializer_list<unsigned long> time) {
        return SetPosition(std::vector<double>(position), std::vector<unsigned long>(time));
    }
    virtual std::int32_t GetPosition(std::vector<OPRoS::Float64>& position) {
        return opros::detail::get_numbers(*this, &Manipulator::GetPosition, position);
    }
};

#endif
