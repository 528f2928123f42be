// SPDX-License-Identifier: Apache-2.0
#ifndef SERVICEPORTCONNECTOR_H_
#define SERVICEPORTCONNECTOR_H_

#include <OPRoSTypes.h>
#include <ReturnType.h>

#include <string>
#include <vector>

/// What a required method calls when its peer is not a method in this host.
class ServicePortConnector {
  public:
    virtual ~ServicePortConnector() {}
    /// The result comes in with a value of the type it has to have. Fails by return code or MethodInvokeException.
    virtual ReturnType requestService(const std::string& name, std::vector<opros_params>& params,
                                      opros_params& result, int callType) = 0;
    virtual ReturnType responseService(std::string& name, std::string& invalue, std::string& outvalue) = 0;
};

#endif
