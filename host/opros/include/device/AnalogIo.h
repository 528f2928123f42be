// SPDX-License-Identifier: Apache-2.0
#ifndef DEVICE_ANALOGIO_H_
#define DEVICE_ANALOGIO_H_

#include "Device.h"

/// Analogue inputs and outputs.
class AnalogIo : public Device {
  public:
    AnalogIo() {}
    virtual ~AnalogIo() {}
    virtual int SetAnalogOutputData(std::vector<double>) { return API_NOT_SUPPORTED; }
    virtual int GetAnalogInputData(std::vector<double>&) { return API_NOT_SUPPORTED; }
};

#endif
