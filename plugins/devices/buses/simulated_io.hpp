// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugins/devices/simulated_device.hpp"

#include <vector>

namespace tandem::devices {

/// Outputs that are wired to the inputs. Before anything is set, there is one input, at rest.
template <typename Value>
struct LoopedBack {
    std::vector<Value> values = std::vector<Value>(1);
};

template <typename Class>
class SimulatedAnalog : public Class {
  public:
    int SetAnalogOutputData(std::vector<double> outputs) override {
        return this->serve([&](double, double) { wires_.values = outputs; });
    }
    int GetAnalogInputData(std::vector<double>& inputs) override {
        return this->serve([&](double, double) { inputs = wires_.values; });
    }

  private:
    LoopedBack<double> wires_;
};

template <typename Class>
class SimulatedDigital : public Class {
  public:
    int SetDigitalOutputData(std::vector<bool> outputs) override {
        return this->serve([&](double, double) { wires_.values = outputs; });
    }
    int GetDigitalnputData(std::vector<bool>& inputs) override {
        return this->serve([&](double, double) { inputs = wires_.values; });
    }

  private:
    LoopedBack<bool> wires_;
};

} // namespace tandem::devices
