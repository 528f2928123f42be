// SPDX-License-Identifier: Apache-2.0
#ifndef RTC_CORBAPORT_H
#define RTC_CORBAPORT_H
#include <memory>
#include <rtm/CorbaConsumer.h>
#include <rtm/PortBase.h>
#include <string>
#include <vector>

namespace RTC {

/// A service port: any number of provided and required interfaces. A consumer gets the provider of the same
/// type and instance name at the other port, unless the connection's properties map it explicitly. Providers
/// can be called only while their component is active: others get CORBA::OBJECT_NOT_EXIST.
class CorbaPort : public PortBase {
  public:
    explicit CorbaPort(const char* name);
    ~CorbaPort() override;
    /// Called with the port's properties of rtc.conf when the port is added to its component.
    void init(coil::Properties& prop);
    /// `provider` stays the caller's and must outlive the port; it may be any servant, dynamic ones included.
    bool registerProvider(const char* instance_name, const char* type_name,
                          PortableServer::ServantBase& provider);
    /// `consumer` stays the caller's and must outlive the port. Returns false, as above, if the name is in use.
    bool registerConsumer(const char* instance_name, const char* type_name, CorbaConsumerBase& consumer);

    void activateInterfaces() override;
    void deactivateInterfaces() override;
    /// Ours: also waits (1 s at most) for activations that wait for calls of the last one. A component may have declared a servant
    /// behind its port, so that it is destroyed first.
    void retire() override;

  protected:
    ReturnCode_t publishInterfaces(ConnectorProfile& connector_profile) override;
    ReturnCode_t subscribeInterfaces(const ConnectorProfile& connector_profile) override;
    void unsubscribeInterfaces(const ConnectorProfile& connector_profile) override;

  private:
    class Provider;
    /// A required interface and the IOR of its present provider; empty when there is none.
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

// As in OpenRTM-aist: components use the manager without including its header. Last, since it needs what is
// above.
#include <rtm/Manager.h>
#endif
