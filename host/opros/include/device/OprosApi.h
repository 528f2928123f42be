// SPDX-License-Identifier: Apache-2.0
// What a device API library offers: it exports `OprosApi* GetAPI()`.
#ifndef DEVICE_OPROSAPI_H_
#define DEVICE_OPROSAPI_H_

#include "ApiTypes.h"
#include "Property.h"

#include <dlfcn.h>

#define OprosApiHandle void*
#define API_SUCCESS 0
#define API_ERROR -1
#define API_NOT_SUPPORTED -2
#define API_EXECUTING 1

/// A device, as a component drives it. All functions return one of the codes above, and API_NOT_SUPPORTED unless
/// overridden. The component calls them in its callbacks, and so in their threads: Initialize and Finalize in
/// onInitialize and onDestroy, Enable and Disable in onStart and onStop, the others as a rule in its cycle.
class OprosApi {
  public:
    OprosApi() {}
    virtual ~OprosApi() {}
    /// Opens the device. The component's properties, which name ports and rates, come along.
    virtual int Initialize(Property) { return API_NOT_SUPPORTED; }
    virtual int Finalize() { return API_NOT_SUPPORTED; }
    virtual int Enable() { return API_NOT_SUPPORTED; }
    virtual int Disable() { return API_NOT_SUPPORTED; }
    /// Changes or reads settings while the device is in use.
    virtual int SetParameter(Property) { return API_NOT_SUPPORTED; }
    virtual int GetParameter(Property&) { return API_NOT_SUPPORTED; }
    virtual int OnExecute() { return API_NOT_SUPPORTED; }
};

/// The type of GetAPI(). Each call makes a device, which the component deletes.
typedef OprosApi* (*GET_OPROS_API)();

#endif
