// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_ANALOGDIGITALIO_H_
#define DEVICE_ANALOGDIGITALIO_H_

#include "Device.h"

/// Analogue and digital inputs and outputs.
class AnalogDigitalIo : public Device {
  public:
    AnalogDigitalIo() {}
    virtual ~AnalogDigitalIo() {}
    virtual int SetAnalogOutputData(std::vector<double>) { return API_NOT_SUPPORTED; }
    virtual int GetAnalogInputData(std::vector<double>&) { return API_NOT_SUPPORTED; }
    virtual int SetDigitalOutputData(std::vector<bool>) { return API_NOT_SUPPORTED; }
    /// The spelling of OPRoS v1.1.
    virtual int GetDigitalnputData(std::vector<bool>&) { return API_NOT_SUPPORTED; }
    virtual int GetDigitalInputData(std::vector<bool>& inputs) { return GetDigitalnputData(inputs); }
};

#endif
