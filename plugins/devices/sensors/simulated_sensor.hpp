// SPDX-License-Identifier: Apache-2.0
// Base classes of sensors whose value is a list with one entry per channel.
#pragma once

#include "plugins/devices/simulated_device.hpp"

#include <cmath>
#include <vector>

namespace tandem::devices {

/// Returns a sine with amplitude 1 and a period of 10 s. Each channel is 1 rad ahead of the previous one. Most sensors
/// scale it. It is slow enough for a plot, and differs between channels.
inline double sine(int channel, double seconds) { return std::sin(0.2 * M_PI * seconds + channel); }

/// A sensor with `Size` channels, whose values are functions of time. `Class` has GetSensorValue(vector<Value>&).
template <typename Class, typename Value>
class SimulatedSensor : public SimulatedDevice<Class> {
  public:
    using Class::GetSensorValue;
    int GetSensorValue(std::vector<Value>& values) override {
        return collect(values, [this](int channel, double seconds) { return value_at(channel, seconds); });
    }

  protected:
    /// Returns in `values` what value(channel, seconds) is for each channel.
    template <typename Each, typename Function>
    int collect(std::vector<Each>& values, Function value) {
        return this->perform([&](double seconds, double) {
            values.clear();
            for (int i = 0; i < channels_; ++i) values.push_back(value(i, seconds));
        });
    }
    /// Returns the value of a channel, counted from 0, at a time in s after Initialize(). [lock held]
    virtual Value value_at(int channel, double seconds) = 0;
    /// Returns the number of channels from the parameters.
    virtual int configured_channels() { return this->count_parameter("Size", 1); }
    void configure() override { channels_ = configured_channels(); }

  private:
    int channels_ = 1;
};

/// A sensor that is only a function of channel and time, like most sensors.
template <typename Class, typename Value, Value (*function)(int channel, double seconds)>
class FunctionSensor : public SimulatedSensor<Class, Value> {
    Value value_at(int channel, double seconds) override { return function(channel, seconds); }
};

/// A sensor whose values have another type in OPRoS v2.
template <typename Sensor, typename Value, Value (*function)(int channel, double seconds)>
class SensorOfBothVersions : public Sensor {
  public:
    using Sensor::GetSensorValue;
    int GetSensorValue(std::vector<Value>& values) override { return this->collect(values, function); }
};

} // namespace tandem::devices
