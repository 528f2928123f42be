// SPDX-License-Identifier: Apache-2.0
#ifndef PROVIDEDMETHODINTERFACE_H_
#define PROVIDEDMETHODINTERFACE_H_

#include <Method.h>
#include <OPRoSTypes.h>
#include <ReturnType.h>
#include <archive/opros_archive.h>

/// The values of one encoded call (ours): a bridge fills it in, for a method whose C++ types it does not know.
class EncodedCall {
  public:
    virtual ~EncodedCall() {}
    /// The archive with argument `index`; NULL when the caller sends none: the method gets a default-constructed value.
    virtual opros::archive::iarchive* argument(int index) = 0;
    /// Where the result is written; not asked for void.
    virtual opros::archive::oarchive& result() = 0;
    /// Where the value is written that the method left in the writable argument `index`; NULL when nobody wants it.
    virtual opros::archive::oarchive* written_argument(int index) = 0;
};

/// A method that can be called without knowing its C++ type. The call runs in the caller's thread; what the method
/// throws passes through.
class ProvidedMethodInterface : public Method {
  public:
    ProvidedMethodInterface() {}
    explicit ProvidedMethodInterface(const std::string& name) : Method(name) {}
    virtual ProvidedMethodInterface* provided() { return this; }
    /// With arguments read from `in`, one after the other, and the result written to `out`.
    /// OPROS_UNSUPPORTED_METHOD: one of the types cannot be archived.
    virtual ReturnType call(opros::archive::iarchive& in, opros::archive::oarchive& out) = 0;
    /// The same with the arguments that the method writes to (ours). The archives are asked for in the order of a reply:
    /// arguments, result, written arguments.
    virtual ReturnType call(EncodedCall&) { return OPROS_UNSUPPORTED_METHOD; }
    /// With values; those that the method writes to have changed afterwards. OPROS_BAD_INPUT_PARAMETER: their number or a type is another one.
    virtual ReturnType call(std::vector<opros_params>& params, opros_params& result) = 0;
};

#endif
