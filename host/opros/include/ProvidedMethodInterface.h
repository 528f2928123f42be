// SPDX-License-Identifier: Apache-2.0
#ifndef PROVIDEDMETHODINTERFACE_H_
#define PROVIDEDMETHODINTERFACE_H_

#include <Method.h>
#include <OPRoSTypes.h>
#include <ReturnType.h>
#include <archive/opros_archive.h>

/// The values of one encoded call (ours). A bridge implements it for a method whose C++ types it does not know.
class EncodedCall {
  public:
    virtual ~EncodedCall() {}
    /// Returns the archive with argument `index`, or NULL if the caller sends none. The method then gets a
    /// default-constructed value.
    virtual opros::archive::iarchive* argument(int index) = 0;
    /// Returns the archive for the result. Not called for void.
    virtual opros::archive::oarchive& result() = 0;
    /// Returns the archive for the value that the method left in the writable argument `index`, or NULL if it is not
    /// needed.
    virtual opros::archive::oarchive* written_argument(int index) = 0;
};

/// A method that can be called without knowing its C++ type. The call runs in the caller's thread. Exceptions of the
/// method pass through.
class ProvidedMethodInterface : public Method {
  public:
    ProvidedMethodInterface() {}
    explicit ProvidedMethodInterface(const std::string& name) : Method(name) {}
    virtual ProvidedMethodInterface* provided() { return this; }
    /// Calls the method with arguments read from `in`, one after the other, and writes the result to `out`. Returns
    /// OPROS_UNSUPPORTED_METHOD if a type cannot be archived.
    virtual ReturnType call(opros::archive::iarchive& in, opros::archive::oarchive& out) = 0;
    /// Calls the method and also returns the arguments that it writes (ours). Requests the archives in the order of a
    /// reply: arguments, result, written arguments.
    virtual ReturnType call(EncodedCall&) { return OPROS_UNSUPPORTED_METHOD; }
    /// Calls the method with values and changes those that the method writes. Returns OPROS_BAD_INPUT_PARAMETER if
    /// their number or a type is wrong.
    virtual ReturnType call(std::vector<opros_params>& params, opros_params& result) = 0;
};

#endif
