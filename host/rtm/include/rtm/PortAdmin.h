// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_PORTADMIN_H
#define RTC_PORTADMIN_H
#include <mutex>
#include <rtm/PortBase.h>
#include <vector>

namespace RTC {

/// The ports of a component, in the order in which they were added, and delegated ports of other components.
/// [any-thread]
class PortAdmin {
  public:
    PortServiceList* getPortServiceList() const;
    PortProfileList getPortProfileList() const;
    PortService_ptr getPortRef(const char* port_name) const;
    /// Finds one of the component's own ports by `<port>` or `<instance>.<port>`. Returns NULL if there is none.
    PortBase* getPort(const char* port_name) const;
    /// Adds a port, which its owner keeps. Returns false if there is one with this name.
    bool addPort(PortBase& port);
    /// Disconnects and deactivates the port, then removes it. Returns false if it is not a port of this component.
    bool removePort(PortBase& port);
    /// Lists a port of another component as this one's own, like a composite. Returns false if it is already listed.
    bool addPort(PortService_ptr port);
    bool removePort(PortService_ptr port);
    void activatePorts();
    void deactivatePorts();
    /// Removes and deactivates all own ports. Afterwards there are no calls from outside.
    void finalizePorts();
    /// Ours: calls PortBase::rehearse() of own ports, as far as time permits. Waits for no lock.
    void rehearsePorts();

  private:
    std::vector<PortBase*> ports() const;
    std::vector<PortService_var> delegatedPorts() const;

    mutable std::mutex mutex_;
    std::vector<PortBase*> ports_;
    std::vector<PortService_var> delegated_ports_;
};

} // namespace RTC
#endif
