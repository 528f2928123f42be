// SPDX-License-Identifier: Apache-2.0
#ifndef REQUIREDSERVICEPORT_H_
#define REQUIREDSERVICEPORT_H_

#include <ServicePortConnector.h>
#include <ServicePortInterface.h>

class ProvidedServicePort;

class RequiredServicePort : public ServicePortInterface {
  public:
    RequiredServicePort();
    explicit RequiredServicePort(const std::string& name);
    virtual ~RequiredServicePort();
    virtual ServicePortRole getRole();
    /// Dynamic ports only: gets the provided port at connection, and NULL at disconnection. A text is a refusal
    /// (ours).
    virtual std::string bindProvided(ProvidedServicePort* provided);
};

#endif
