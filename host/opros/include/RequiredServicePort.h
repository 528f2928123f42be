// SPDX-License-Identifier: Apache-2.0
#ifndef REQUIREDSERVICEPORT_H_
#define REQUIREDSERVICEPORT_H_

#include <ServicePortConnector.h>
#include <ServicePortInterface.h>

class ProvidedServicePort;

/// The side of a service that calls the methods. Generated code derives from it, adds its required methods, and calls
/// them in functions of the same names. A port has one provider at most.
class RequiredServicePort : public ServicePortInterface {
  public:
    RequiredServicePort();
    explicit RequiredServicePort(const std::string& name);
    virtual ~RequiredServicePort();
    virtual ServicePortRole getRole();
    /// Dynamic ports only: gets the provided port at connection, and NULL at disconnection. Returns why it is refused,
    /// or an empty text (ours).
    virtual std::string bindProvided(ProvidedServicePort* provided);
};

#endif
