// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_SERVOACTUATOR_H_
#define DEVICE_SERVOACTUATOR_H_

#include "Actuator.h"

/// Encoder, gear and limits of a servo drive, for components that store them.
class ServoActuatorProfile : public ActuatorProfile {
  public:
    ServoActuatorProfile()
        : linePerRevolution(0), reductionRatio(0), maximumVelocity(0), acceleration(0),
          minimumPositionLimit(0), maximumPositionLimit(0) {}
    double linePerRevolution, reductionRatio, maximumVelocity, acceleration;
    double minimumPositionLimit, maximumPositionLimit;
};

/// A drive that holds a velocity or a position. `time` is how long it takes to reach it, in milliseconds; 0: at once.
class ServoActuator : public Actuator {
  public:
    ServoActuator() {}
    virtual ~ServoActuator() {}
    virtual int SetVelocity(double /*velocity*/, unsigned long /*time*/ = 0) { return API_NOT_SUPPORTED; }
    virtual int GetVelocity(double&) { return API_NOT_SUPPORTED; }
    virtual int SetPosition(double /*position*/, unsigned long /*time*/ = 0) { return API_NOT_SUPPORTED; }
    virtual int GetPosition(double&) { return API_NOT_SUPPORTED; }

    // The forms of OPRoS v2.
    virtual std::int32_t SetVelocity(OPRoS::Float64 velocity) { return SetVelocity(velocity.data); }
    virtual std::int32_t GetVelocity(OPRoS::Float64& velocity) { return GetVelocity(velocity.data); }
    virtual std::int32_t SetPosition(OPRoS::Float64 position, OPRoS::UInt32 time) {
        return SetPosition(position.data, static_cast<unsigned long>(time.data));
    }
    virtual std::int32_t GetPosition(OPRoS::Float64& position) { return GetPosition(position.data); }
};

#endif
