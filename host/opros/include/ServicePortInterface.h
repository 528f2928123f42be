// SPDX-License-Identifier: Apache-2.0
#ifndef SERVICEPORTINTERFACE_H_
#define SERVICEPORTINTERFACE_H_

#include <Method.h>
#include <ServicePort.h>

#include <map>

class ServicePortConnector;

/// A service port and its methods by their names. It owns them: made with new, deleted with the port or when another
/// one of the same name is added. [main-thread] Methods are added before the port is connected.
class ServicePortInterface : public ServicePort {
  public:
    typedef std::map<std::string, Method*> service_base;

    ServicePortInterface();
    explicit ServicePortInterface(const std::string& name);
    virtual ~ServicePortInterface();
    /// All methods, in alphabetical order.
    virtual service_base::iterator getFirst();
    virtual service_base::iterator getEnd();
    /// OPROS_BAD_INPUT_PARAMETER: NULL.
    virtual ReturnType addMethod(const std::string& name, Method* srv);
    /// NULL when there is no method of this name.
    virtual Method* getMethod(const std::string& name);

  private:
    ServicePortInterface(const ServicePortInterface&);
    ServicePortInterface& operator=(const ServicePortInterface&);
    service_base m_methods;
};

#endif
