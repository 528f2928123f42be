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

/// The ports of a component under their names. The component owns data and event ports, usually as members, and this
/// class owns service ports, which are made with new. Add ports in the constructor or in onInitialize(). A port that
/// is added later is connected at once as the application profile says; do not add one from within a push.
/// [any-thread]
class PortInterface {
  public:
    PortInterface();
    virtual ~PortInterface();
    /// Adds a port. Replaces a port of the same kind and name, whose connections end. Returns
    /// OPROS_BAD_INPUT_PARAMETER for NULL.
    virtual ReturnType addPort(const std::string& name, Port* port);
    /// Removes a port, ends its connections and returns it, or NULL if no port has this name. The caller then
    /// owns a removed service port (ours).
    virtual Port* removePort(const std::string& name);
    /// Adds a listener. On return from removePortListener() it is not in use (ours).
    void addPortListener(PortListener* listener);
    void removePortListener(PortListener* listener);
    /// Returns the port of this name, or NULL. Searches data, then event, then service ports.
    virtual Port* getPort(const std::string& name);
    /// Calls reset() of all ports.
    virtual void portReset();
    /// Returns the names of all ports of this kind (ours).
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
