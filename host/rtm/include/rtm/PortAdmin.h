// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_PORTADMIN_H
#define RTC_PORTADMIN_H
#include <mutex>
#include <rtm/PortBase.h>
#include <vector>

namespace RTC {

/// The ports of a component, in the order they were added, and those of others that it delegates to.
/// [any-thread]
class PortAdmin {
  public:
    PortServiceList* getPortServiceList() const;
    PortProfileList getPortProfileList() const;
    PortService_ptr getPortRef(const char* port_name) const;
    /// By `<port>` or `<instance>.<port>`; NULL when there is none. Own ports only.
    PortBase* getPort(const char* port_name) const;
    /// The port stays its owner's. Returns false if there is one of that name.
    bool addPort(PortBase& port);
    /// Disconnects and deactivates the port first. Returns false if it is not one of this component.
    bool removePort(PortBase& port);
    /// Ports of other components that this one lists as its own, as a composite does.
    bool addPort(PortService_ptr port);
    bool removePort(PortService_ptr port);
    void activatePorts();
    void deactivatePorts();
    /// Removes and deactivates all own ports; no calls from outside after that.
    void finalizePorts();
    /// Ours: PortBase::warmUp() of own ports, as many as there is time for; waits for no lock.
    void warmUpPorts();

  private:
    std::vector<PortBase*> ports() const;
    std::vector<PortService_var> delegatedPorts() const;

    mutable std::mutex mutex_;
    std::vector<PortBase*> ports_;
    std::vector<PortService_var> delegated_ports_;
};

} // namespace RTC
#endif
