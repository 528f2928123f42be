// SPDX-License-Identifier: Apache-2.0
// The API of a device library of OPRoS v2, which exports `OprosDevice* GetAPI()`.
#ifndef DEVICE_OPROSDEVICE_H_
#define DEVICE_OPROSDEVICE_H_

#include "ApiTypes.h"
#include "Property.h"

#include <dlfcn.h>

#define OprosDeviceHandle void*
#define API_SUCCESS 0
#define API_ERROR -1
#define API_NOT_SUPPORTED -2
#define API_EXECUTING 1

/// A device as a component of OPRoS v2 uses it. OprosApi.h describes the functions and their threads. Each class of
/// devices has the functions of v1.1 and of v2, so that a component finds those of its version. If only the types differ,
/// those of v2 call those of v1.1, and a component of v2 can use a device of v1.1.
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

/// The type of GetAPI() in OPRoS v2.
typedef OprosDevice* (*GET_OPROS_DEVICE)();

#endif
