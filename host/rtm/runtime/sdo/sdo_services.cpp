// SPDX-License-Identifier: Apache-2.0
// OpenRTM-aist: class SdoServiceAdmin.
#include "host/rtm/runtime/sdo/sdo_services.hpp"
#include "host/rtm/runtime/sdo/tool_services.hpp"
#include <algorithm>
#include <coil/stringutil.h>
#include <rtm/CORBA_SeqUtil.h>

namespace RTC {
namespace {

using Lock = std::lock_guard<std::recursive_mutex>;

// Each service of a tool has a thread.
constexpr std::size_t max_consumers = 32;

template <class Service>
typename std::vector<Service*>::iterator find_by_id(std::vector<Service*>& services, const std::string& id) {
    return std::find_if(services.begin(), services.end(), [&](Service* service) {
        return id == static_cast<const char*>(service->getProfile().id);
    });
}

// Finalizes a service and gives it up.
void release(SdoServiceProviderBase* provider) {
    provider->finalize();
    provider->_remove_ref(); // a servant: a call in progress still holds a reference
}

void release(SdoServiceConsumerBase* consumer) {
    consumer->finalize();
    auto& factory = SdoServiceConsumerFactory::instance();
    // The factory does not know the services of this runtime, nor a type that was unregistered meanwhile.
    if (factory.deleteObject(consumer) != coil::FactoryReturn::OK) delete consumer;
}

// A library's consumer takes the place of this runtime's.
SdoServiceConsumerBase* make_consumer(const std::string& type) {
    SdoServiceConsumerBase* consumer = SdoServiceConsumerFactory::instance().createObject(type);
    return consumer != nullptr ? consumer : make_tool_service(type).release();
}

// The caller owns the reference.
PortableServer::ServantBase* refer_to(RTObject_impl& component) {
    component._add_ref();
    return &component;
}

} // namespace

SdoServices::SdoServices(RTObject_impl& owner, const coil::Properties& config)
    : owner_(owner), config_(config) {}

SdoServices::~SdoServices() { finalize(); }

// `kind` is provider or consumer.
bool SdoServices::is_enabled(const char* kind, const std::string& type) const {
    const std::string enabled =
        config_.getProperty(std::string("sdo.service.") + kind + ".enabled_services", "ALL");
    return coil::includes(enabled, "all") || coil::includes(enabled, type);
}

// The id of such a provider is its interface type, because there is one provider of each type.
void SdoServices::start_providers() {
    for (const auto& type : SdoServiceProviderFactory::instance().getIdentifiers()) {
        if (!is_enabled("provider", type)) continue;
        SdoServiceProviderBase* provider = SdoServiceProviderFactory::instance().createObject(type);
        if (provider == nullptr) continue;
        SDOPackage::ServiceProfile profile;
        profile.id = CORBA::string_dup(type.c_str());
        profile.interface_type = CORBA::string_dup(type.c_str());
        profile.service = provider->_this();
        if (!add_provider(profile, provider)) release(provider);
    }
}

// Without the mutex, like release_tools(). All links to tools end at the same time, because a tool that hangs takes seconds.
void SdoServices::finalize() {
    std::vector<SdoServiceProviderBase*> providers;
    std::vector<SdoServiceConsumerBase*> consumers;
    {
        Lock lock(mutex_);
        providers.swap(providers_);
        consumers.swap(consumers_);
    }
    for (auto* provider : providers) release(provider);
    for (auto* consumer : consumers)
        if (auto* service = dynamic_cast<ToolService*>(consumer)) service->begin_finalize();
    for (auto* consumer : consumers) release(consumer);
}

// The mutex is recursive, because init() and finalize() of a service may ask the component for its services.
bool SdoServices::add_provider(const SDOPackage::ServiceProfile& profile, SdoServiceProviderBase* provider) {
    Lock lock(mutex_);
    if (find_by_id(providers_, static_cast<const char*>(profile.id)) != providers_.end()) return false;
    if (!provider->init(owner_, profile)) return false;
    providers_.push_back(provider);
    return true;
}

bool SdoServices::remove_provider(const std::string& id) {
    Lock lock(mutex_);
    auto found = find_by_id(providers_, id);
    if (found == providers_.end()) return false;
    release(*found);
    providers_.erase(found);
    return true;
}

// Without the mutex: listeners of the component that ask for its services may be under way, and a consumer waits for them.
// The reference keeps the component, which may end meanwhile.
void SdoServices::release_tools(const std::string& id) {
    std::vector<SdoServiceConsumerBase*> released;
    PortableServer::ServantBase_var component;
    {
        Lock lock(mutex_);
        std::erase_if(consumers_, [&](auto* consumer) {
            auto* service = dynamic_cast<ToolService*>(consumer);
            if (service == nullptr) return false;
            if (!service->is_lost() && id != static_cast<const char*>(service->getProfile().id)) return false;
            released.push_back(consumer);
            return true;
        });
        if (!released.empty()) component = refer_to(owner_);
    }
    for (auto* consumer : released) release(consumer);
}

bool SdoServices::add_consumer(const SDOPackage::ServiceProfile& profile) {
    release_tools(static_cast<const char*>(profile.id));
    Lock lock(mutex_);
    auto found = find_by_id(consumers_, static_cast<const char*>(profile.id));
    if (found != consumers_.end()) return (*found)->reinit(profile);
    const std::string type(profile.interface_type);
    if (!is_enabled("consumer", type) || consumers_.size() >= max_consumers) return false;
    SdoServiceConsumerBase* consumer = make_consumer(type);
    if (consumer == nullptr) return false;
    if (!consumer->init(owner_, profile)) {
        release(consumer);
        return false;
    }
    consumers_.push_back(consumer);
    return true;
}

// Without the mutex, like release_tools().
bool SdoServices::remove_consumer(const std::string& id) {
    SdoServiceConsumerBase* consumer = nullptr;
    PortableServer::ServantBase_var component;
    {
        Lock lock(mutex_);
        auto found = find_by_id(consumers_, id);
        if (found == consumers_.end()) return false;
        consumer = *found;
        component = refer_to(owner_);
        consumers_.erase(found);
    }
    release(consumer);
    return true;
}

SDOPackage::ServiceProfileList* SdoServices::profiles() const {
    Lock lock(mutex_);
    SDOPackage::ServiceProfileList_var list = new SDOPackage::ServiceProfileList;
    for (auto* provider : providers_) CORBA_SeqUtil::push_back(list.inout(), provider->getProfile());
    return list._retn();
}

// Consumers are not listed: their services belong to tools.
SDOPackage::ServiceProfile SdoServices::profile(const std::string& id) const {
    Lock lock(mutex_);
    for (auto* provider : providers_)
        if (id == static_cast<const char*>(provider->getProfile().id)) return provider->getProfile();
    throw SDOPackage::InvalidParameter(("no SDO service " + id).c_str());
}

} // namespace RTC
