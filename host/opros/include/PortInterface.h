// SPDX-License-Identifier: Apache-2.0
#ifndef PORTINTERFACE_H_
#define PORTINTERFACE_H_

#include <Port.h>
#include <ReturnType.h>

#include <map>
#include <string>
#include <vector>

/// The ports of a component under their names. Data and event ports are owned by the component, as members as a rule.
/// Service ports are owned by this class: made with new, deleted with it or when another one of the same name is
/// added. [main-thread] Ports are added in the component's constructor and in onInitialize(), before the host
/// connects them.
class PortInterface {
  public:
    PortInterface();
    virtual ~PortInterface();
    /// OPROS_BAD_INPUT_PARAMETER: NULL. A port of the same kind and name is replaced.
    virtual ReturnType addPort(const std::string& name, Port* port);
    /// NULL when there is no port of this name; looks among data, then event, then service ports.
    virtual Port* getPort(const std::string& name);
    /// reset() of all ports.
    virtual void portReset();
    /// The names of all ports of this kind (ours).
    virtual std::vector<std::string> getPortNames(PortType type) const;

  private:
    PortInterface(const PortInterface&);
    PortInterface& operator=(const PortInterface&);
    typedef std::map<std::string, Port*> PortMap;
    PortMap* portsOf(PortType type);

    PortMap m_data, m_event, m_service;
};

#endif
