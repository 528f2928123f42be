// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_PORTADMIN_H
#define RTC_PORTADMIN_H
#include <mutex>
#include <rtm/PortBase.h>
#include <vector>

namespace RTC {

/// The ports of a component, in the order they were added. [any-thread]
class PortAdmin {
  public:
    PortServiceList* getPortServiceList() const;
    PortProfileList getPortProfileList() const;
    PortService_ptr getPortRef(const char* port_name) const;
    /// By `port` or `<instance>.port`; NULL when there is none.
    PortBase* getPort(const char* port_name) const;
    /// False when there is one of that name.
    bool addPort(PortBase& port);
    bool removePort(PortBase& port);
    /// Ports of other components, which are listed here as well; they stay theirs.
    bool addPort(PortService_ptr port);
    bool removePort(PortService_ptr port);
    void activatePorts();
    void deactivatePorts();
    /// Disconnects all and lets no more calls in.
    void finalizePorts();

  private:
    std::vector<PortBase*> ports() const;
    std::vector<PortService_var> delegatedPorts() const;

    mutable std::mutex mutex_;
    std::vector<PortBase*> ports_;
    std::vector<PortService_var> delegated_ports_;
};

} // namespace RTC
#endif
