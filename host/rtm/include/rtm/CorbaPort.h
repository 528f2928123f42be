// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_CORBAPORT_H
#define RTC_CORBAPORT_H
#include <memory>
#include <rtm/CorbaConsumer.h>
#include <rtm/PortBase.h>
#include <string>
#include <vector>

namespace RTC {

/// A service port: any number of provided and required interfaces. A consumer gets the provider of the same type and
/// instance name at the other port, unless the connection's properties map it explicitly. Providers can be called
/// only while their component is active. Other calls get CORBA::OBJECT_NOT_EXIST.
class CorbaPort : public PortBase {
  public:
    explicit CorbaPort(const char* name);
    ~CorbaPort() override;
    /// Is called with the port's properties of rtc.conf when the port is added to its component.
    void init(coil::Properties& prop);
    /// Adds a provided interface. Returns false if the name is in use or the servant cannot be activated. The caller
    /// keeps ownership of `provider`, which must outlive the port and may be any servant, including a dynamic one.
    bool registerProvider(const char* instance_name, const char* type_name,
                          PortableServer::ServantBase& provider);
    /// Adds a required interface. Returns false if the name is in use. The caller keeps ownership of `consumer`, which
    /// must outlive the port.
    bool registerConsumer(const char* instance_name, const char* type_name, CorbaConsumerBase& consumer);

    void activateInterfaces() override;
    void deactivateInterfaces() override;
    /// Ours: also waits (1 s at most) for activations that wait for calls of the last one. A component may have
    /// declared a servant after its port, so that the servant is destroyed first.
    void retire() override;

  protected:
    ReturnCode_t publishInterfaces(ConnectorProfile& connector_profile) override;
    ReturnCode_t subscribeInterfaces(const ConnectorProfile& connector_profile) override;
    void unsubscribeInterfaces(const ConnectorProfile& connector_profile) override;

  private:
    class Provider;
    /// A required interface and the IOR of its current provider; empty if there is none.
    struct Consumer {
        std::string type, instance;
        CorbaConsumerBase* consumer;
        std::string ior;
        std::string descriptor() const { return type + "." + instance; }
    };
    std::string propertyKey(const char* polarity, const std::string& descriptor) const;
    std::string findProviderIor(const NVList& properties, const Consumer& consumer) const;
    bool bindConsumer(const std::string& ior, Consumer& consumer);

    std::vector<std::unique_ptr<Provider>> m_providers;
    std::vector<Consumer> m_consumers;
};

} // namespace RTC

// As in OpenRTM-aist: components use the manager without including its header. Last, because it needs the
// declarations above.
#include <rtm/Manager.h>
#endif
