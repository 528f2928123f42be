// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/registered_transports.hpp"
#include <rtm/InPortConsumer.h>
#include <rtm/NVUtil.h>
#include <rtm/OutPortConsumer.h>

namespace RTC {
namespace {

template <class Object>
void return_to_factory(Object* object) {
    coil::GlobalFactory<Object>::instance().deleteObject(object);
}
template <class Object>
using Made = std::unique_ptr<Object, void (*)(Object*)>;
template <class Object>
Made<Object> make(const std::string& type) {
    return {coil::GlobalFactory<Object>::instance().createObject(type), &return_to_factory<Object>};
}

// Either end of a type may be here alone: the other is in the peer's process.
template <class One, class Other>
std::string registered(const coil::Properties& connector_properties) {
    const std::string type = coil::eraseBothEndsBlank(connector_properties.getProperty("interface_type"));
    const bool there = coil::GlobalFactory<One>::instance().hasFactory(type) ||
                       coil::GlobalFactory<Other>::instance().hasFactory(type);
    return there ? type : "";
}

class Receiver : public RemoteReceiver {
  public:
    Receiver(Made<InPortConsumer> consumer, const SDOPackage::NVList& properties)
        : consumer_(std::move(consumer)), properties_(properties) {}
    ~Receiver() override { consumer_->unsubscribeInterface(properties_); }
    std::optional<DataPortStatus> put(const ByteData& bytes) override {
        ByteData copy(bytes); // the consumer's to change
        return consumer_->put(copy);
    }
    void setTimeout(std::chrono::milliseconds) override {} // its own affair

  private:
    Made<InPortConsumer> consumer_;
    SDOPackage::NVList properties_;
};

class Sender : public RemoteSender {
  public:
    Sender(Made<OutPortConsumer> consumer, const SDOPackage::NVList& properties)
        : consumer_(std::move(consumer)), properties_(properties) {}
    ~Sender() override { consumer_->unsubscribeInterface(properties_); }
    std::optional<DataPortStatus> get(ByteData& bytes) override { return consumer_->get(bytes); }
    bool answers() override { return true; }
    void setTimeout(std::chrono::milliseconds) override {}

  private:
    Made<OutPortConsumer> consumer_;
    SDOPackage::NVList properties_;
};

} // namespace

std::string registered_push(const coil::Properties& connector_properties) {
    return registered<InPortConsumer, InPortProvider>(connector_properties);
}

std::string registered_pull(const coil::Properties& connector_properties) {
    return registered<OutPortConsumer, OutPortProvider>(connector_properties);
}

void append_registered_types(SDOPackage::NVList& port_properties, bool in_port) {
    auto append = [&](const std::vector<std::string>& types) {
        for (const auto& type : types)
            NVUtil::appendStringValue(port_properties, "dataport.interface_type", type.c_str());
    };
    append(in_port ? InPortProviderFactory::instance().getIdentifiers()
                   : InPortConsumerFactory::instance().getIdentifiers());
    append(in_port ? OutPortConsumerFactory::instance().getIdentifiers()
                   : OutPortProviderFactory::instance().getIdentifiers());
}

std::unique_ptr<RemoteReceiver> registered_receiver(const std::string& type, const ConnectorProfile& profile,
                                                    coil::Properties prop) {
    auto consumer = make<InPortConsumer>(type);
    if (consumer == nullptr) return nullptr;
    consumer->init(prop);
    if (!consumer->subscribeInterface(profile.properties)) return nullptr;
    return std::make_unique<Receiver>(std::move(consumer), profile.properties);
}

std::unique_ptr<RemoteSender> registered_sender(const std::string& type, const ConnectorProfile& profile,
                                                const ConnectorInfo& info, ConnectorListenersBase& listeners,
                                                CdrBufferBase& buffer, coil::Properties prop) {
    auto consumer = make<OutPortConsumer>(type);
    if (consumer == nullptr) return nullptr;
    consumer->init(prop);
    consumer->setBuffer(&buffer);
    ConnectorInfo told(info);
    consumer->setListener(told, &listeners);
    if (!consumer->subscribeInterface(profile.properties)) return nullptr;
    return std::make_unique<Sender>(std::move(consumer), profile.properties);
}

RegisteredInPortProvider registered_in_provider(const std::string& type, coil::Properties prop) {
    auto provider = make<InPortProvider>(type);
    if (provider != nullptr) provider->init(prop);
    return provider;
}

RegisteredOutPortProvider registered_out_provider(const std::string& type, coil::Properties prop) {
    auto provider = make<OutPortProvider>(type);
    if (provider != nullptr) provider->init(prop);
    return provider;
}

} // namespace RTC
