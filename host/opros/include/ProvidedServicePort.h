// SPDX-License-Identifier: Apache-2.0
#ifndef PROVIDEDSERVICEPORT_H_
#define PROVIDEDSERVICEPORT_H_

#include <ServicePortInterface.h>

class EncodedCall;
struct CallValue;

/// The side of a service that implements the methods. Generated code derives from it and adds the methods in its
/// constructor. Calls run in the callers' threads, several at a time.
class ProvidedServicePort : public ServicePortInterface {
  public:
    ProvidedServicePort();
    explicit ProvidedServicePort(const std::string& name);
    virtual ~ProvidedServicePort();
    virtual ServicePortRole getRole();

    /// Calls the method with encoded arguments. Returns OPROS_UNSUPPORTED_METHOD if there is no such method or a type
    /// cannot be archived. Exceptions of the method pass through.
    virtual ReturnType callService(std::string& name, opros::archive::iarchive& in,
                                   opros::archive::oarchive& out);
    /// Calls the method with encoded arguments and returns the arguments that it writes to (ours).
    virtual ReturnType callService(const std::string& name, EncodedCall& call);
    /// Calls the method with values. Returns OPROS_BAD_INPUT_PARAMETER if number or types of the arguments are wrong.
    virtual ReturnType callService(std::string& name, std::vector<opros_params>& params,
                                   opros_params& result);
    /// Calls a method known from bindMethod(), with the values in the caller's memory (ours). Returns
    /// OPROS_UNSUPPORTED_METHOD if this port takes no such calls.
    virtual ReturnType callEncoded(Method& required, const CallValue* arguments, int count,
                                   const CallValue& result);
    /// Is called at connection for each method of the required port (dynamic ports only). Returns an empty text, or
    /// why the method is refused (ours).
    virtual std::string bindMethod(Method* required);
};

#endif
