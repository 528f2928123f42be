// SPDX-License-Identifier: Apache-2.0
#ifndef PROVIDEDMETHODINTERFACE_H_
#define PROVIDEDMETHODINTERFACE_H_

#include <Method.h>
#include <OPRoSTypes.h>
#include <ReturnType.h>
#include <archive/opros_archive.h>

/// A method that can be called without knowing its C++ type. The call runs in the caller's thread; what the method
/// throws passes through.
class ProvidedMethodInterface : public Method {
  public:
    ProvidedMethodInterface() {}
    explicit ProvidedMethodInterface(const std::string& name) : Method(name) {}
    /// With arguments read from `in`, one after the other, and the result written to `out`.
    /// OPROS_UNSUPPORTED_METHOD: one of the types cannot be archived.
    virtual ReturnType call(opros::archive::iarchive& in, opros::archive::oarchive& out) = 0;
    /// With values. OPROS_BAD_INPUT_PARAMETER: their number or a type is another one.
    virtual ReturnType call(std::vector<opros_params>& params, opros_params& result) = 0;
};

#endif
