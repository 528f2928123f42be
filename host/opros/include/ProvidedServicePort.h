// SPDX-License-Identifier: Apache-2.0
#ifndef PROVIDEDSERVICEPORT_H_
#define PROVIDEDSERVICEPORT_H_

#include <ServicePortInterface.h>

class EncodedCall;
struct CallValue;

/// The side of a service that has the methods. Generated code derives from it and adds them in its constructor. Calls
/// come in the threads of the callers, several at a time.
class ProvidedServicePort : public ServicePortInterface {
  public:
    ProvidedServicePort();
    explicit ProvidedServicePort(const std::string& name);
    virtual ~ProvidedServicePort();
    virtual ServicePortRole getRole();

    /// Calls the method with encoded arguments. OPROS_UNSUPPORTED_METHOD: no such method, or a type that cannot be
    /// archived. What the method throws passes through.
    virtual ReturnType callService(std::string& name, opros::archive::iarchive& in,
                                   opros::archive::oarchive& out);
    /// The same with the arguments that the method writes to (ours).
    virtual ReturnType callService(const std::string& name, EncodedCall& call);
    /// The same with values. OPROS_BAD_INPUT_PARAMETER: not the method's number or types of arguments.
    virtual ReturnType callService(std::string& name, std::vector<opros_params>& params,
                                   opros_params& result);
    /// The same for a method that bindMethod() has seen, with the values where the caller has them (ours).
    /// OPROS_UNSUPPORTED_METHOD: this port takes no such calls.
    virtual ReturnType callEncoded(Method& required, const CallValue* arguments, int count,
                                   const CallValue& result);
    /// Dynamic ports only: called at connection for each method of the required port. Returns why it is refused, or an
    /// empty text (ours).
    virtual std::string bindMethod(Method* required);
};

#endif
