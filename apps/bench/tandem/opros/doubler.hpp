// SPDX-License-Identifier: Apache-2.0
// The service of the bench's OPRoS components, written as OPRoS's generators write service ports: as a component's own code.
#pragma once
#include <ProvidedMethod.h>
#include <ProvidedServicePort.h>
#include <RequiredMethod.h>
#include <RequiredServicePort.h>

namespace tandem::bench {

/// The interface of the service.
class IDoubler {
  public:
    virtual ~IDoubler() {}
    virtual double twice(double value) = 0;
};

/// The provided side: calls go to the owner.
class DoublerProvided : public ProvidedServicePort, public IDoubler {
  public:
    explicit DoublerProvided(IDoubler* owner) {
        Method* method = makeProvidedMethod(&IDoubler::twice, owner, "twice");
        addMethod("twice", method);
        twice_ = reinterpret_cast<ProvidedMethod<double>*>(method);
    }
    double twice(double value) override { return (*twice_)(value); }

  private:
    ProvidedMethod<double>* twice_;
};

/// The required side: calls go to the connected service port.
class DoublerRequired : public RequiredServicePort {
  public:
    DoublerRequired() {
        Method* method = makeRequiredMethod(&DoublerRequired::twice, "twice");
        addMethod("twice", method);
        twice_ = reinterpret_cast<RequiredMethod<double>*>(method);
    }
    double twice(double value) { return (*twice_)(value); }

  private:
    RequiredMethod<double>* twice_;
};

} // namespace tandem::bench
