// SPDX-License-Identifier: Apache-2.0
// The API of a device library, which exports `OprosApi* GetAPI()`.
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

/// A device as a component uses it. All functions return one of the codes above, by default API_NOT_SUPPORTED. The
/// component calls them in its callbacks and therefore in the threads of its callbacks: Initialize and Finalize in
/// onInitialize and onDestroy, Enable and Disable in onStart and onStop, the others usually in its cycle.
class OprosApi {
  public:
    OprosApi() {}
    virtual ~OprosApi() {}
    /// Opens the device. The argument has the component's properties, which name ports and rates.
    virtual int Initialize(Property) { return API_NOT_SUPPORTED; }
    virtual int Finalize() { return API_NOT_SUPPORTED; }
    virtual int Enable() { return API_NOT_SUPPORTED; }
    virtual int Disable() { return API_NOT_SUPPORTED; }
    /// Changes or reads settings while the device is in use.
    virtual int SetParameter(Property) { return API_NOT_SUPPORTED; }
    virtual int GetParameter(Property&) { return API_NOT_SUPPORTED; }
    virtual int OnExecute() { return API_NOT_SUPPORTED; }
};

/// The type of GetAPI(). Each call creates a device, which the component deletes.
typedef OprosApi* (*GET_OPROS_API)();

#endif
