// SPDX-License-Identifier: Apache-2.0
#ifndef SERVICEPORTCONNECTOR_H_
#define SERVICEPORTCONNECTOR_H_

#include <OPRoSTypes.h>
#include <ReturnType.h>

#include <string>
#include <vector>

/// What a required method calls when it is not connected to a provided method directly: it takes the call elsewhere, to
/// another thread or another process. [any-thread]
class ServicePortConnector {
  public:
    virtual ~ServicePortConnector() {}
    /// Calls the method `name` with the values. `result` comes in with a value of the type it must have. Any code but
    /// OPROS_SUCCESS becomes a MethodInvokeException in the caller; it may also throw one itself.
    virtual ReturnType requestService(const std::string& name, std::vector<opros_params>& params,
                                      opros_params& result, int callType) = 0;
    /// Upstream's, for its distribution; not called by this host.
    virtual ReturnType responseService(std::string& name, std::string& invalue, std::string& outvalue) = 0;
};

#endif
