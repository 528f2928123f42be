// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_DIGITALIO_H_
#define DEVICE_DIGITALIO_H_

#include "Device.h"

/// Digital inputs and outputs.
class DigitalIo : public Device {
  public:
    DigitalIo() {}
    virtual ~DigitalIo() {}
    virtual int SetDigitalOutputData(std::vector<bool>) { return API_NOT_SUPPORTED; }
    /// The spelling of OPRoS v1.1.
    virtual int GetDigitalnputData(std::vector<bool>&) { return API_NOT_SUPPORTED; }
    virtual int GetDigitalInputData(std::vector<bool>& inputs) { return GetDigitalnputData(inputs); }
};

#endif
