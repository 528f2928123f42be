// SPDX-License-Identifier: Apache-2.0
#include "plugins/devices/sensors/simulated_sensor.hpp"

#include <device/GyroSensor.h>

namespace {

/// Turns back and forth by 1 rad; rad.
class SimulatedGyroSensor : public tandem::devices::SimulatedSensor<GyroSensor, ObjectRotation> {
  public:
    /// Returns the same values with the name and type of OPRoS v1.
    int GetGyroSensorData(std::vector<ObjectLocation>& values) override {
        std::vector<ObjectRotation> rotations;
        const int result = GetSensorValue(rotations);
        values.clear();
        for (const ObjectRotation& rotation : rotations) values.push_back(ObjectLocation(0, 0, rotation.yaw));
        return result;
    }

  protected:
    ObjectRotation value_at(int channel, double seconds) override {
        return ObjectRotation(0, 0, tandem::devices::sine(channel, seconds));
    }
};

/// Returns the yaw and its derivative for OPRoS v2.
OPRoS::GyroSensorData turn(int channel, double seconds) {
    const double rate = 0.2 * M_PI * std::cos(0.2 * M_PI * seconds + channel);
    return {0, 0, tandem::devices::sine(channel, seconds), 0, 0, rate};
}

} // namespace

TANDEM_DEVICE(GyroSensor,
              tandem::devices::SensorOfBothVersions<SimulatedGyroSensor, OPRoS::GyroSensorData, turn>)
