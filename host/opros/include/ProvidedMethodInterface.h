// SPDX-License-Identifier: Apache-2.0
#ifndef PROVIDEDMETHODINTERFACE_H_
#define PROVIDEDMETHODINTERFACE_H_

#include <Method.h>
#include <OPRoSTypes.h>
#include <ReturnType.h>
#include <archive/opros_archive.h>

class ProvidedMethodInterface : public Method {
  public:
    ProvidedMethodInterface() {}
    explicit ProvidedMethodInterface(const std::string& name) : Method(name) {}
    virtual ReturnType call(opros::archive::iarchive& in, opros::archive::oarchive& out) = 0;
    virtual ReturnType call(std::vector<opros_params>& params, opros_params& result) = 0;
};

#endif
