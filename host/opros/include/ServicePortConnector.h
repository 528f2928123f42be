// SPDX-License-Identifier: Apache-2.0
#ifndef SERVICEPORTCONNECTOR_H_
#define SERVICEPORTCONNECTOR_H_

#include <OPRoSTypes.h>
#include <ReturnType.h>

#include <string>
#include <vector>

class Method;

/// An argument or the result of one call in the caller's memory (ours). A connector encodes it from there and decodes
/// it to there, without a copy. Both functions throw archive_type_exception for a type that cannot be archived.
struct CallValue {
    void* address;
    void (*encode)(const void* address, opros::archive::oarchive& to);
    /// Reads one value and drops it if the caller's value must not be written.
    void (*decode)(void* address, opros::archive::iarchive& from);

    void encode_to(opros::archive::oarchive& to) const { encode(address, to); }
    void decode_from(opros::archive::iarchive& from) const { decode(address, from); }
};

/// Called by a required method without a direct connection to a provided method. It passes the call to another thread
/// or process. [any-thread]
class ServicePortConnector {
  public:
    virtual ~ServicePortConnector() {}
    /// Calls the method `name` with the values. On entry, `result` holds a value of the required type. Any code
    /// except OPROS_SUCCESS becomes a MethodInvokeException in the caller. May also throw one itself.
    virtual ReturnType requestService(const std::string& name, std::vector<opros_params>& params,
                                      opros_params& result, int callType) = 0;
    /// Calls the method without copying the values (ours). `result` of a method without one decodes nothing. Called
    /// first; if it returns OPROS_UNSUPPORTED_METHOD, the call goes through requestService().
    virtual ReturnType requestEncoded(Method&, const CallValue* /*arguments*/, int /*count*/,
                                      const CallValue& /*result*/) {
        return OPROS_UNSUPPORTED_METHOD;
    }
    /// Exists for upstream's distribution. This host does not call it.
    virtual ReturnType responseService(std::string& name, std::string& invalue, std::string& outvalue) = 0;
};

#endif
