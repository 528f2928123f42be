// SPDX-License-Identifier: Apache-2.0
#ifndef PORTINTERFACE_H_
#define PORTINTERFACE_H_

#include <Port.h>
#include <ReturnType.h>

#include <map>
#include <string>
#include <vector>

/// The ports of a component under their names. Data and event ports belong to the component; service ports belong to
/// this class and are deleted with it, or when another one of the same name is added.
class PortInterface {
  public:
    PortInterface();
    virtual ~PortInterface();
    virtual ReturnType addPort(const std::string& name, Port* port);
    /// NULL when there is no port of this name; looks among data, then event, then service ports.
    virtual Port* getPort(const std::string& name);
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
