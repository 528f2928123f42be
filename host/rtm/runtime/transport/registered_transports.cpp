// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/registered_transports.hpp"
#include <rtm/InPortConsumer.h>
#include <rtm/NVUtil.h>
#include <rtm/OutPortConsumer.h>

namespace RTC {
namespace {

// Objects go back to the factory that made them: the library that defines the class must delete them.
template <class Object>
void return_to_factory(Object* object) {
    coil::GlobalFactory<Object>::instance().deleteObject(object);
}
template <class Object>
using FactoryPtr = std::unique_ptr<Object, void (*)(Object*)>;
template <class Object>
FactoryPtr<Object> create(const std::string& type) {
    return {coil::GlobalFactory<Object>::instance().createObject(type), &return_to_factory<Object>};
}

// A connection may ask for a type of which only one end is registered here: the peer's process has the other.
template <class Consumer, class Provider>
std::string registered_type(const coil::Properties& connector_properties) {
    const std::string type = coil::eraseBothEndsBlank(connector_properties.getProperty("interface_type"));
    const bool is_registered = coil::GlobalFactory<Consumer>::instance().hasFactory(type) ||
                               coil::GlobalFactory<Provider>::instance().hasFactory(type);
    return is_registered ? type : "";
}

/// A library's consumer for push, as our connectors use receivers.
class Receiver : public RemoteReceiver {
  public:
    Receiver(FactoryPtr<InPortConsumer> consumer, const SDOPackage::NVList& properties)
        : consumer_(std::move(consumer)), properties_(properties) {}
    ~Receiver() override { consumer_->unsubscribeInterface(properties_); }
    std::optional<DataPortStatus> put(const ByteData& bytes) override {
        ByteData copy(bytes); // put() takes it by non-const reference and may change it
        return consumer_->put(copy);
    }
    void set_timeout(std::chrono::milliseconds) override {} // InPortConsumer has no such function

  private:
    FactoryPtr<InPortConsumer> consumer_;
    SDOPackage::NVList properties_;
};

/// A library's consumer for pull, as our connectors use senders.
class Sender : public RemoteSender {
  public:
    Sender(FactoryPtr<OutPortConsumer> consumer, const SDOPackage::NVList& properties)
        : consumer_(std::move(consumer)), properties_(properties) {}
    ~Sender() override { consumer_->unsubscribeInterface(properties_); }
    std::optional<DataPortStatus> get(ByteData& bytes) override { return consumer_->get(bytes); }
    // An OutPortConsumer cannot be asked without taking a message.
    bool responds() override { return true; }
    void set_timeout(std::chrono::milliseconds) override {}

  private:
    FactoryPtr<OutPortConsumer> consumer_;
    SDOPackage::NVList properties_;
};

} // namespace

std::string registered_push_type(const coil::Properties& connector_properties) {
    return registered_type<InPortConsumer, InPortProvider>(connector_properties);
}

std::string registered_pull_type(const coil::Properties& connector_properties) {
    return registered_type<OutPortConsumer, OutPortProvider>(connector_properties);
}

void append_registered_types(SDOPackage::NVList& port_properties, bool in_port) {
    auto append = [&](const std::vector<std::string>& types) {
        for (const auto& type : types)
            NVUtil::appendStringValue(port_properties, "dataport.interface_type", type.c_str());
    };
    // Push: an InPort provides, an OutPort consumes; pull: the other way round.
    append(in_port ? InPortProviderFactory::instance().getIdentifiers()
                   : InPortConsumerFactory::instance().getIdentifiers());
    append(in_port ? OutPortConsumerFactory::instance().getIdentifiers()
                   : OutPortProviderFactory::instance().getIdentifiers());
}

std::unique_ptr<RemoteReceiver>
create_registered_receiver(const std::string& type, const ConnectorProfile& profile, coil::Properties prop) {
    auto consumer = create<InPortConsumer>(type);
    if (consumer == nullptr) return nullptr;
    consumer->init(prop);
    if (!consumer->subscribeInterface(profile.properties)) return nullptr;
    return std::make_unique<Receiver>(std::move(consumer), profile.properties);
}

std::unique_ptr<RemoteSender>
create_registered_sender(const std::string& type, const ConnectorProfile& profile, const ConnectorInfo& info,
                         ConnectorListenersBase& listeners, CdrBufferBase& buffer, coil::Properties prop) {
    auto consumer = create<OutPortConsumer>(type);
    if (consumer == nullptr) return nullptr;
    consumer->init(prop);
    consumer->setBuffer(&buffer);
    ConnectorInfo consumer_info(info);
    consumer->setListener(consumer_info, &listeners);
    if (!consumer->subscribeInterface(profile.properties)) return nullptr;
    return std::make_unique<Sender>(std::move(consumer), profile.properties);
}

RegisteredInPortProvider create_registered_in_provider(const std::string& type, coil::Properties prop) {
    auto provider = create<InPortProvider>(type);
    if (provider != nullptr) provider->init(prop);
    return provider;
}

RegisteredOutPortProvider create_registered_out_provider(const std::string& type, coil::Properties prop) {
    auto provider = create<OutPortProvider>(type);
    if (provider != nullptr) provider->init(prop);
    return provider;
}

} // namespace RTC
