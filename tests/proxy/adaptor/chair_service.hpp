// SPDX-License-Identifier: Apache-2.0
// A service in the style of generated OPRoS code: interface, provided and required port.
#pragma once

#include <ProvidedMethod.h>
#include <ProvidedServicePort.h>
#include <RequiredMethod.h>
#include <RequiredServicePort.h>

#include <string>
#include <vector>

class IChair {
  public:
    virtual ~IChair() = default;
    virtual std::vector<double> limits(int axis) = 0;
    virtual std::string name() = 0;
};

class ChairProvided : public ProvidedServicePort, public IChair {
  public:
    explicit ChairProvided(IChair* owner) {
        addMethod("limits", makeProvidedMethod(&IChair::limits, owner, "limits"));
        addMethod("name", makeProvidedMethod(&IChair::name, owner, "name"));
    }
    std::vector<double> limits(int axis) override { return (*method<std::vector<double>>("limits"))(axis); }
    std::string name() override { return (*method<std::string>("name"))(); }

  private:
    template <class R>
    ProvidedMethod<R>* method(const char* name) {
        return reinterpret_cast<ProvidedMethod<R>*>(getMethod(name));
    }
};

class ChairRequired : public RequiredServicePort {
  public:
    ChairRequired() {
        addMethod("limits", makeRequiredMethod(&ChairRequired::limits, "limits"));
        addMethod("name", makeRequiredMethod(&ChairRequired::name, "name"));
    }
    std::vector<double> limits(int axis) { return (*method<std::vector<double>>("limits"))(axis); }
    std::string name() { return (*method<std::string>("name"))(); }

  private:
    template <class R>
    RequiredMethod<R>* method(const char* name) {
        return reinterpret_cast<RequiredMethod<R>*>(getMethod(name));
    }
};
