// SPDX-License-Identifier: Apache-2.0
#ifndef SERVICEPORTCONNECTOR_H_
#define SERVICEPORTCONNECTOR_H_

#include <OPRoSTypes.h>
#include <ReturnType.h>

#include <string>
#include <vector>

class Method;

/// An argument or the result of one call, where the caller has it (ours): what takes the call elsewhere encodes it from there
/// and decodes it to there, without a copy. Both functions throw archive_type_exception for a type that cannot be archived.
struct CallValue {
    void* address;
    void (*encode)(const void* address, opros::archive::oarchive& to);
    /// Reads one value; it is dropped when the caller's cannot be written.
    void (*decode)(void* address, opros::archive::iarchive& from);

    void encode_to(opros::archive::oarchive& to) const { encode(address, to); }
    void decode_from(opros::archive::iarchive& from) const { decode(address, from); }
};

/// What a required method calls when it is not connected to a provided method directly: it takes the call elsewhere, to
/// another thread or another process. [any-thread]
class ServicePortConnector {
  public:
    virtual ~ServicePortConnector() {}
    /// Calls the method `name` with the values. `result` comes in with a value of the type it must have. Any code but
    /// OPROS_SUCCESS becomes a MethodInvokeException in the caller; it may also throw one itself.
    virtual ReturnType requestService(const std::string& name, std::vector<opros_params>& params,
                                      opros_params& result, int callType) = 0;
    /// The same without copies of the values (ours). `result` of a method without one decodes nothing. Asked first;
    /// OPROS_UNSUPPORTED_METHOD: the call is made by the function above.
    virtual ReturnType requestEncoded(Method&, const CallValue* /*arguments*/, int /*count*/,
                                      const CallValue& /*result*/) {
        return OPROS_UNSUPPORTED_METHOD;
    }
    /// Upstream's, for its distribution; not called by this host.
    virtual ReturnType responseService(std::string& name, std::string& invalue, std::string& outvalue) = 0;
};

#endif
