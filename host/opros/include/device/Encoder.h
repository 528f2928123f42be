// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_ENCODER_H_
#define DEVICE_ENCODER_H_

#include "Sensor.h"

/// Resolution and gear, for components that store them.
class EncoderProfile : public SensorProfile {
  public:
    EncoderProfile() : linePerRevolution(0), reductionRatio(0) {}
    double linePerRevolution, reductionRatio;
};

/// Angles of shafts.
class Encoder : public Sensor {
  public:
    Encoder() {}
    virtual ~Encoder() {}
    virtual int GetSensorValue(std::vector<double>&) { return API_NOT_SUPPORTED; }
    /// Its name in OPRoS v1.
    virtual int GetEncoderData(std::vector<double>& values) { return GetSensorValue(values); }
};

#endif
