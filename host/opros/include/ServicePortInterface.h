// SPDX-License-Identifier: Apache-2.0
#ifndef SERVICEPORTINTERFACE_H_
#define SERVICEPORTINTERFACE_H_

#include <Method.h>
#include <ServicePort.h>

#include <map>

class ServicePortConnector;

/// A service port with its methods by name. It owns the methods, which are made with new. It deletes a method with
/// the port or when a method of the same name is added. Add methods before the port is connected. [main-thread]
class ServicePortInterface : public ServicePort {
  public:
    typedef std::map<std::string, Method*> service_base;

    ServicePortInterface();
    explicit ServicePortInterface(const std::string& name);
    virtual ~ServicePortInterface();
    /// Returns an iterator over all methods in alphabetical order.
    virtual service_base::iterator getFirst();
    virtual service_base::iterator getEnd();
    /// Adds a method. Returns OPROS_BAD_INPUT_PARAMETER for NULL.
    virtual ReturnType addMethod(const std::string& name, Method* srv);
    /// Returns the method of this name, or NULL.
    virtual Method* getMethod(const std::string& name);

  private:
    ServicePortInterface(const ServicePortInterface&);
    ServicePortInterface& operator=(const ServicePortInterface&);
    service_base m_methods;
};

#endif
