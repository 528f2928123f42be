// SPDX-License-Identifier: Apache-2.0
// CorbaPort: service ports, whose providers publish IORs and whose consumers get them.
#include "host/rtm/runtime/port/provider.hpp"
#include "host/rtm/runtime/port/remote_port.hpp"
#include <algorithm>
#include <coil/stringutil.h>
#include <rtm/CorbaPort.h>
#include <rtm/Manager.h>

namespace RTC {
namespace {

// The time limit of service calls, in ms. A service may take long (an arm moves, a user is asked), so the default is
// 600 s, much longer than for the framework's own calls. The maximum is what the ORB's ULong of ms can hold.
CORBA::ULong configured_call_timeout_ms() {
    double seconds = 600;
    const auto& config = Manager::instance().getConfig();
    if (!coil::stringTo(seconds, config.getProperty("manager.service_call_timeout").c_str()) ||
        !(seconds > 0))
        seconds = 600;
    return static_cast<CORBA::ULong>(std::clamp(seconds * 1000, 1., 4e9));
}

} // namespace

CorbaPort::CorbaPort(const char* name) : PortBase(name) { addProperty("port.port_type", "CorbaPort"); }
CorbaPort::~CorbaPort() { CorbaPort::retire(); }

void CorbaPort::retire() {
    PortBase::retire();
    deactivateInterfaces();
    for (auto& provider : m_providers) provider->wait_for_activation();
}

void CorbaPort::init(coil::Properties& prop) {
    m_properties << prop;
    {
        const std::lock_guard lock(m_profile_mutex);
        NVUtil::mergeFromProperties(m_profile.properties, m_properties);
    }
    initConnectionLimit();
}

bool CorbaPort::registerProvider(const char* instance_name, const char* type_name,
                                 PortableServer::ServantBase& provider) {
    if (!appendInterface(instance_name, type_name, PROVIDED)) return false;
    try {
        m_providers.push_back(std::make_unique<Provider>(type_name, instance_name, provider));
        return true;
    } catch (const CORBA::Exception& e) {
        RTC_ERROR(("provider %s.%s cannot be activated: %s", type_name, instance_name, e._name()));
        // The profile must not offer what cannot be called.
        deleteInterface(instance_name, PROVIDED);
        return false;
    }
}

bool CorbaPort::registerConsumer(const char* instance_name, const char* type_name,
                                 CorbaConsumerBase& consumer) {
    if (!appendInterface(instance_name, type_name, REQUIRED)) return false;
    m_consumers.push_back({type_name, instance_name, &consumer, ""});
    return true;
}

// If one provider fails, the others, and the component, still become active.
void CorbaPort::activateInterfaces() {
    const std::string name(getName()); // `Component.port`
    const std::string start = m_ownerInstanceName + ".";
    const std::string own_name = name.starts_with(start) ? name.substr(start.size()) : name;
    for (auto& provider : m_providers) {
        try {
            provider->activate(m_ownerInstanceName, own_name);
        } catch (const CORBA::Exception& e) {
            RTC_ERROR(("provider %s cannot be activated: %s", provider->descriptor().c_str(), e._name()));
        }
    }
}
void CorbaPort::deactivateInterfaces() {
    for (auto& provider : m_providers) provider->deactivate();
}

// The key of an interface in a connection's profile, as OpenRTM-aist 1.1 and later build it:
// <component>.port.<port>.<polarity>.<type>.<instance>
std::string CorbaPort::propertyKey(const char* polarity, const std::string& descriptor) const {
    const std::string name(m_profile.name);
    return m_ownerInstanceName + ".port." + name.substr(name.rfind('.') + 1) + "." + polarity + "." +
           descriptor;
}

ReturnCode_t CorbaPort::publishInterfaces(ConnectorProfile& profile) {
    const ReturnCode_t allowed = _publishInterfaces();
    if (allowed != RTC_OK) return allowed;
    const bool is_remote = has_remote_port(profile);
    for (auto& provider : m_providers) {
        // Under the key of 1.1 and later, and under the short one of 1.0.
        const std::string key = propertyKey("provided", provider->descriptor());
        CORBA_SeqUtil::push_back(profile.properties, NVUtil::newNV(key.c_str(), provider->ior().c_str()));
        CORBA_SeqUtil::push_back(profile.properties, NVUtil::newNV(("port." + provider->descriptor()).c_str(),
                                                                   provider->ior().c_str()));
        if (is_remote) provider->offer_shared_calls(profile, key);
    }
    return RTC_OK;
}

// Returns the IOR of the provider for a consumer: the IOR that the profile explicitly maps to the consumer, or else the
// one of the same type and instance name. Empty if there is none. `nil` or `null` if the mapping gives the consumer no
// provider.
std::string CorbaPort::findProviderIor(const NVList& properties, const Consumer& consumer) const {
    std::string mapped = NVUtil::toString(properties, propertyKey("required", consumer.descriptor()).c_str());
    if (mapped == "nil" || mapped == "null") return mapped;
    const std::string ior = mapped.empty() ? "" : NVUtil::toString(properties, mapped.c_str());
    return ior.empty() ? NVUtil::toString(properties, ("port." + consumer.descriptor()).c_str()) : ior;
}

// A consumer without a provider is an error only for a strict connection (port.connection.strictness).
ReturnCode_t CorbaPort::subscribeInterfaces(const ConnectorProfile& profile) {
    const bool strict = NVUtil::isStringValue(profile.properties, "port.connection.strictness", "strict");
    for (auto& consumer : m_consumers) {
        const std::string ior = findProviderIor(profile.properties, consumer);
        if (!ior.empty() && bindConsumer(ior, consumer)) {
            share_calls_if_possible(consumer.consumer->getObject(), ior, profile);
            continue;
        }
        const std::string reason = std::string(getName()) + ": no provider for " + consumer.type +
                                   ", instance name " + consumer.instance + ", on the other side";
        if (strict) return refuse(RTC_ERROR, reason);
        if (ior.empty()) RTC_DEBUG(("%s", reason.c_str()));
    }
    return RTC_OK;
}

// Gives the consumer its reference. Logs a message and returns false if the reference cannot be called. Returns true
// for an explicit `nil`.
bool CorbaPort::bindConsumer(const std::string& ior, Consumer& consumer) {
    if (ior == "nil" || ior == "null") return true;
    try {
        CORBA::Object_var object = Manager::instance().theORB()->string_to_object(ior.c_str());
        omniORB::setClientCallTimeout(object.in(),
                                      configured_call_timeout_ms()); // setObject()'s _narrow keeps it
        if (!consumer.consumer->setObject(object.in())) {
            RTC_ERROR(("consumer %s: the object of the other side is not a %s", consumer.instance.c_str(),
                       consumer.type.c_str()));
            return false;
        }
    } catch (const CORBA::SystemException& e) {
        RTC_ERROR(("consumer %s: the provider cannot be reached: %s", consumer.instance.c_str(), e._name()));
        return false;
    }
    consumer.ior = ior;
    return true;
}

// Consumers of this connection no longer have a provider. Calls through them throw.
void CorbaPort::unsubscribeInterfaces(const ConnectorProfile& profile) {
    for (auto& provider : m_providers)
        provider->end_shared_calls(static_cast<const char*>(profile.connector_id));
    for (auto& consumer : m_consumers) {
        // A later connection may have given the consumer another provider, which it keeps.
        if (consumer.ior.empty() || findProviderIor(profile.properties, consumer) != consumer.ior) continue;
        consumer.consumer->releaseObject();
        consumer.ior.clear();
    }
}

} // namespace RTC
