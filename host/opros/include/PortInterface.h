// SPDX-License-Identifier: Apache-2.0
#ifndef PORTINTERFACE_H_
#define PORTINTERFACE_H_

#include <Port.h>
#include <PortListener.h>
#include <ReturnType.h>

#include <map>
#include <string>
#include <vector>

namespace opros {
namespace detail {
struct port_state;
}
} // namespace opros

/// The ports of a component under their names. Data and event ports are owned by the component, as members as a rule, and
/// live as long as it. Service ports are owned by this class: made with new, deleted with it. [any-thread] Ports are added
/// in the component's constructor and in onInitialize(), before the host connects them. One that is added later is connected
/// then, as the application profile says; not from within a push.
class PortInterface {
  public:
    PortInterface();
    virtual ~PortInterface();
    /// OPROS_BAD_INPUT_PARAMETER: NULL. A port of the same kind and name is replaced; its connections end.
    virtual ReturnType addPort(const std::string& name, Port* port);
    /// Takes a port out, also a service port, which is the caller's from then on: its connections end. NULL when there is
    /// none of this name (ours).
    virtual Port* removePort(const std::string& name);
    /// On return of removePortListener() the listener is not in use (ours).
    void addPortListener(PortListener* listener);
    void removePortListener(PortListener* listener);
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
    Port* find(const std::string& name);

    opros::detail::port_state* const m_state;
    PortMap m_data, m_event, m_service;
};

#endif
