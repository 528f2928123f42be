// SPDX-License-Identifier: Apache-2.0
#ifndef SERVICEPORTINTERFACE_H_
#define SERVICEPORTINTERFACE_H_

#include <Method.h>
#include <ServicePort.h>

#include <map>

class ServicePortConnector;

/// A service port and its methods, which it owns.
class ServicePortInterface : public ServicePort {
  public:
    typedef std::map<std::string, Method*> service_base;

    ServicePortInterface();
    explicit ServicePortInterface(const std::string& name);
    virtual ~ServicePortInterface();
    virtual service_base::iterator getFirst();
    virtual service_base::iterator getEnd();
    virtual ReturnType addMethod(const std::string& name, Method* srv);
    /// NULL when there is no method of this name.
    virtual Method* getMethod(const std::string& name);

  private:
    ServicePortInterface(const ServicePortInterface&);
    ServicePortInterface& operator=(const ServicePortInterface&);
    service_base m_methods;
};

#endif
