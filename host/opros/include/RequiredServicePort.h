// SPDX-License-Identifier: Apache-2.0
#ifndef REQUIREDSERVICEPORT_H_
#define REQUIREDSERVICEPORT_H_

#include <ServicePortConnector.h>
#include <ServicePortInterface.h>

class ProvidedServicePort;

/// The side of a service that calls the methods. Generated code derives from it, adds its required methods, and calls
/// them in functions of the same names. A port has at most one provider.
class RequiredServicePort : public ServicePortInterface {
  public:
    RequiredServicePort();
    explicit RequiredServicePort(const std::string& name);
    virtual ~RequiredServicePort();
    virtual ServicePortRole getRole();
    /// Receives the provided port at connection and NULL at disconnection (dynamic ports only). Returns an empty
    /// text, or why the port is refused (ours).
    virtual std::string bindProvided(ProvidedServicePort* provided);
};

#endif
