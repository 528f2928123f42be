// SPDX-License-Identifier: Apache-2.0
// The API of a device library of OPRoS v1.1, which exports `OprosApi* GetAPI()`.
#ifndef DEVICE_OPROSAPI_H_
#define DEVICE_OPROSAPI_H_

#include "OprosDevice.h"

#define OprosApiHandle void*

/// A device as a component uses it. All functions return a code of OprosDevice.h, by default API_NOT_SUPPORTED. The
/// component calls them in its callbacks and therefore in the threads of its callbacks: Initialize and Finalize in
/// onInitialize and onDestroy, Enable and Disable in onStart and onStop, the others usually in its cycle.
class OprosApi : public OprosDevice {
  public:
    OprosApi() {}
    virtual ~OprosApi() {}
    /// Opens the device. The argument has the component's properties, which name ports and rates.
    virtual int Initialize(Property) { return API_NOT_SUPPORTED; }
    /// Changes or reads settings while the device is in use.
    virtual int SetParameter(Property) { return API_NOT_SUPPORTED; }
    virtual int GetParameter(Property&) { return API_NOT_SUPPORTED; }
    virtual int OnExecute() { return API_NOT_SUPPORTED; }

    // The functions of OPRoS v2.
    virtual std::int32_t Initialize(OPRoS::Property properties) {
        return Initialize(static_cast<const Property&>(properties));
    }
    virtual std::int32_t SetProperty(OPRoS::Property properties) { return SetParameter(properties); }
    virtual std::int32_t GetProperty(OPRoS::Property& properties) { return GetParameter(properties); }
};

/// The type of GetAPI(). Each call creates a device, which the component deletes.
typedef OprosApi* (*GET_OPROS_API)();

#endif
