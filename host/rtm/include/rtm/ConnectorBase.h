// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_CONNECTORBASE_H
#define RTC_CONNECTORBASE_H
#include <coil/Properties.h>
#include <coil/stringutil.h>
#include <rtm/CdrBufferBase.h>
#include <rtm/DataPortStatus.h>
#include <rtm/RTC.h>
#include <rtm/SystemLogger.h>
#include <string>
#include <vector>

namespace RTC {

/// The description of a connector: name, id, the IORs of the connection's ports, and its properties without the
/// prefix `dataport.`.
class ConnectorInfo {
  public:
    ConnectorInfo() = default;
    ConnectorInfo(const char* name_, const char* id_, coil::vstring ports_,
                  const coil::Properties& properties_)
        : name(name_), id(id_), ports(std::move(ports_)), properties(properties_) {}
    std::string name;
    std::string id;
    coil::vstring ports;
    coil::Properties properties;
};
using ConnectorInfoList = std::vector<ConnectorInfo>;

/// One end of a data connection, owned by its port.
class ConnectorBase {
  public:
    virtual ~ConnectorBase() = default;
    virtual const ConnectorInfo& profile() = 0;
    virtual const char* id() = 0;
    virtual const char* name() = 0;
    virtual DataPortStatus disconnect() = 0;
    /// Returns NULL if this end has no buffer.
    virtual CdrBufferBase* getBuffer() = 0;
    virtual void activate() = 0;
    virtual void deactivate() = 0;
};
using ConnectorList = std::vector<ConnectorBase*>;

} // namespace RTC
#endif
