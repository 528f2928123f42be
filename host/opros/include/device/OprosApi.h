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

class OprosApi {
  public:
    OprosApi() {}
    virtual ~OprosApi() {}
    virtual int Initialize(Property) { return API_NOT_SUPPORTED; }
    virtual int Finalize() { return API_NOT_SUPPORTED; }
    virtual int Enable() { return API_NOT_SUPPORTED; }
    virtual int Disable() { return API_NOT_SUPPORTED; }
    virtual int SetParameter(Property) { return API_NOT_SUPPORTED; }
    virtual int GetParameter(Property&) { return API_NOT_SUPPORTED; }
    virtual int OnExecute() { return API_NOT_SUPPORTED; }
};

typedef OprosApi* (*GET_OPROS_API)();

#endif
