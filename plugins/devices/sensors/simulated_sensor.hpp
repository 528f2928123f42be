// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugins/devices/simulated_device.hpp"

#include <vector>

namespace tandem::devices {

/// A sensor of `Size` channels, each a function of time.
template <typename Class, typename Value>
class SimulatedSensor : public SimulatedDevice<Class> {
  public:
    int GetSensorValue(std::vector<Value>& values) override {
        return this->serve([&](double seconds, double) {
            values.clear();
            for (int i = 0; i < channels_; ++i) values.push_back(at(i, seconds));
        });
    }

  protected:
    virtual Value at(int channel, double seconds) = 0;
    virtual int channels() { return this->count("Size", 1); }
    void configure() override { channels_ = channels(); }

    /// Between -1 and 1 once in ten seconds, each channel a bit later than the one before.
    static double wave(int channel, double seconds) { return std::sin(0.2 * M_PI * seconds + channel); }

  private:
    int channels_ = 1;
};

} // namespace tandem::devices
