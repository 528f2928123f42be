// SPDX-License-Identifier: Apache-2.0
// Inputs and outputs of a digital or analog card, for the device classes AnalogIo, DigitalIo and AnalogDigitalIo. Each
// output is wired to the input with the same number. Before any output is set, there is one input, at rest.
#pragma once

#include "plugins/devices/simulated_device.hpp"

#include <vector>

namespace tandem::devices {

/// Adds the analog functions to `Class`, a SimulatedDevice.
template <typename Class>
class SimulatedAnalog : public Class {
  public:
    int SetAnalogOutputData(std::vector<double> outputs) override { return this->copy(outputs, volts_); }
    int GetAnalogInputData(std::vector<double>& inputs) override { return this->copy(volts_, inputs); }

  private:
    std::vector<double> volts_ = std::vector<double>(1);
};

/// Adds the digital functions to `Class`, a SimulatedDevice.
template <typename Class>
class SimulatedDigital : public Class {
  public:
    int SetDigitalOutputData(std::vector<bool> outputs) override { return this->copy(outputs, levels_); }
    /// The spelling is that of OPRoS.
    int GetDigitalnputData(std::vector<bool>& inputs) override { return this->copy(levels_, inputs); }

  private:
    std::vector<bool> levels_ = std::vector<bool>(1);
};

} // namespace tandem::devices
