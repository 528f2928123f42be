// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_INFRAREDSENSOR_H_
#define DEVICE_INFRAREDSENSOR_H_

#include "Sensor.h"

/// Distances, one per sensor.
class InfraredSensor : public Sensor {
  public:
    InfraredSensor() {}
    virtual ~InfraredSensor() {}
    virtual int GetSensorValue(std::vector<double>&) { return API_NOT_SUPPORTED; }
    /// The form of OPRoS v2.
    virtual std::int32_t GetSensorValue(std::vector<OPRoS::Float64>& values) {
        return opros::detail::get_numbers(*this, &InfraredSensor::GetSensorValue, values);
    }
    /// Its name in OPRoS v1.
    virtual int GetInfraredSensorData(std::vector<double>& values) { return GetSensorValue(values); }
};

#endif
