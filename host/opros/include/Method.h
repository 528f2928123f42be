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

/// Learns the types of a method from Method::describe() (ours). Each function returns the archive from which one
/// default-constructed value of the type is loaded: an archive that records what it is asked for learns the signature.
class MethodDescription {
  public:
    virtual ~MethodDescription() {}
    /// The result; not asked for void.
    virtual opros::archive::iarchive& result() = 0;
    /// The next argument. `writable`: the method gets it by a reference or pointer that is not const, so that the caller
    /// may get it back with another value.
    virtual opros::archive::iarchive& argument(bool writable) = 0;
};

/// A method of a service port, provided or required, which owns it. Its name is the same on both sides.
class Method {
  public:
    Method();
    explicit Method(const std::string& name);
    virtual ~Method();
    virtual std::string& getName();
    /// The result's type by its name on ports; "void" for none.
    virtual std::string& getReturnType() = 0;
    /// The number of arguments.
    virtual int getArity() = 0;
    /// METHOD_BLOCKING or METHOD_NONBLOCKING. The required side's counts: a non-blocking call of a method without a
    /// result returns at once, and is made by the provider's own thread for events and such calls.
    virtual int getCallType() = 0;

    /// Describes the result, then each argument in order. Returns false if a type cannot be archived; some may have
    /// been described (ours).
    virtual bool describe(MethodDescription& description);
    /// The C++ types: the result, then the arguments, without const and reference. Empty when not known (ours).
    virtual std::vector<const std::type_info*> types() const;
    /// "double (std::string, int)", for messages (ours).
    std::string signature();
    /// The same object if it is a method that can be called, otherwise NULL: without a cast at each call (ours).
    virtual ProvidedMethodInterface* provided() { return 0; }

  protected:
    // What a call throws (ours): it was made with other types than the method has, or the connection gave this code.
    [[noreturn]] void refuse_types();
    [[noreturn]] void refuse_call(ReturnType code);

    std::string m_name;
};

#endif
