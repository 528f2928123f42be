// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_POSITIONSENSOR_H_
#define DEVICE_POSITIONSENSOR_H_

#include "ObjectPositionData.h"
#include "Sensor.h"

/// Positions and attitudes.
class PositionSensor : public Sensor {
  public:
    PositionSensor() {}
    virtual ~PositionSensor() {}
    virtual int GetSensorValue(std::vector<ObjectPosition>&) { return API_NOT_SUPPORTED; }
    /// The form of OPRoS v2.
    virtual std::int32_t GetSensorValue(std::vector<OPRoS::ObjectPositionData>& values) {
        std::vector<ObjectPosition> positions;
        const int result = GetSensorValue(positions);
        values.clear();
        for (const ObjectPosition& p : positions)
            values.push_back(OPRoS::ObjectPositionData(p.x, p.y, p.z, p.roll, p.pitch, p.yaw));
        return result;
    }
    /// Its name in OPRoS v1.
    virtual int GetPositionSensorData(std::vector<ObjectPosition>& values) { return GetSensorValue(values); }
};

#endif
