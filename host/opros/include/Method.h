// SPDX-License-Identifier: Apache-2.0
#ifndef METHOD_H_
#define METHOD_H_

#include <ArchiveFactory.h>
#include <Port.h>
#include <ReturnType.h>

#include <string>
#include <typeinfo>
#include <vector>

#define METHOD_BLOCKING 1
#define METHOD_NONBLOCKING 2

class ProvidedMethodInterface;

/// Receives the types of a method from Method::describe() (ours). Each function returns an archive, from which one
/// default-constructed value of the type is loaded. An archive that records these requests learns the signature.
class MethodDescription {
  public:
    virtual ~MethodDescription() {}
    /// Returns the archive for the result. Not called for void.
    virtual opros::archive::iarchive& result() = 0;
    /// Returns the archive for the next argument. `writable`: the method takes it by a non-const reference or pointer,
    /// so the caller may get it back with another value.
    virtual opros::archive::iarchive& argument(bool writable) = 0;
};

/// A method of a provided or required service port, which owns it. Both sides use the same name.
class Method {
  public:
    Method();
    explicit Method(const std::string& name);
    virtual ~Method();
    virtual std::string& getName();
    /// Returns the name of the result's type on ports, or "void" if there is no result.
    virtual std::string& getReturnType() = 0;
    /// Returns the number of arguments.
    virtual int getArity() = 0;
    /// Returns METHOD_BLOCKING or METHOD_NONBLOCKING. The required side's type counts. A non-blocking call of a
    /// method without a result returns at once. The provider's own thread for events and such calls then makes the
    /// call.
    virtual int getCallType() = 0;

    /// Describes the result, then each argument in order. Returns false if a type cannot be archived; some types may
    /// then have been described (ours).
    virtual bool describe(MethodDescription& description);
    /// Returns the C++ types of the result and the arguments, without const and reference. Empty if unknown (ours).
    virtual std::vector<const std::type_info*> types() const;
    /// Returns, for messages, for example "double (std::string, int)" (ours).
    std::string signature();
    /// Returns this object if the method can be called, otherwise NULL. Saves a cast at each call (ours).
    virtual ProvidedMethodInterface* provided() { return 0; }

  protected:
    // Throw the exception of a call (ours): with argument types other than the method's, or with this code of the
    // connection.
    [[noreturn]] void refuse_types();
    [[noreturn]] void refuse_call(ReturnType code);

    std::string m_name;
};

#endif
