// SPDX-License-Identifier: Apache-2.0
// OprosApi.h for devices of OPRoS v2, with the properties and codes of that version.
#ifndef DEVICE_OPROSDEVICE_H_
#define DEVICE_OPROSDEVICE_H_

#include "ApiTypes.h"
#include "OprosApi.h"
#include "Property.h"

#define OprosDeviceHandle void*

class OprosDevice {
  public:
    OprosDevice() {}
    virtual ~OprosDevice() {}
    virtual std::int32_t Initialize(OPRoS::Property) { return API_NOT_SUPPORTED; }
    virtual std::int32_t Finalize() { return API_NOT_SUPPORTED; }
    virtual std::int32_t Enable() { return API_NOT_SUPPORTED; }
    virtual std::int32_t Disable() { return API_NOT_SUPPORTED; }
    virtual std::int32_t SetProperty(OPRoS::Property) { return API_NOT_SUPPORTED; }
    virtual std::int32_t GetProperty(OPRoS::Property&) { return API_NOT_SUPPORTED; }
};

typedef OprosDevice* (*GET_OPROS_DEVICE)();

#endif
