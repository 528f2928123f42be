// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/call/shared_calls.hpp"
#include "SharedCallsSkel.h"
#include "SharedCallsStub.h"
#include "host/rtm/runtime/network/peer_machine.hpp"
#include "host/rtm/runtime/transport/call/call_identity.hpp"
#include "host/rtm/runtime/transport/call/call_sender.hpp"
#include "host/rtm/runtime/transport/call/call_workers.hpp"
#include "host/rtm/runtime/transport/remote_endpoints.hpp"
#include <map>
#include <mutex>
#include <rtm/CORBA_SeqUtil.h>
#include <rtm/Manager.h>
#include <rtm/NVUtil.h>
#include <rtm/SystemLogger.h>

namespace RTC {
namespace {

constexpr std::chrono::seconds open_timeout{10};
// Of one connection: its consumers that use the same provider.
constexpr std::size_t max_segments = 16;

std::string offer_key(const std::string& provider_key) { return provider_key + ".shared_calls_ior"; }

void log_calls_of_orb(const char* reason) {
    const Logger rtclog("connections");
    RTC_DEBUG(("service calls go through the ORB, not through shared memory: %s", reason));
}

/// Returns the offer of the provider with this IOR; nil if there is none.
CORBA::Object_ptr find_offer(const NVList& properties, const std::string& provider_ior) {
    for (CORBA::ULong i = 0; i < properties.length(); ++i) {
        const std::string key(properties[i].name);
        if (!NVUtil::isStringValue(properties, key.c_str(), provider_ior.c_str())) continue;
        const std::string ior = NVUtil::toString(properties, offer_key(key).c_str());
        if (!ior.empty()) return Manager::instance().theORB()->string_to_object(ior.c_str());
    }
    return CORBA::Object::_nil();
}

} // namespace

/// [ORB threads]
class SharedCallsOffer::Servant : public POA_TandemRtm::SharedCalls {
  public:
    explicit Servant(CORBA::Object_ptr object) : object_(CORBA::Object::_duplicate(object)) {}

    CORBA::Boolean open(const char* connection, const char* link) override {
        const std::lock_guard lock(mutex_);
        const auto found = connections_.find(connection);
        if (found == connections_.end() || found->second.size() == max_segments) return false;
        try {
            found->second.push_back(std::make_unique<CallWorkers>(open_call_segment(link), object_.in()));
            return true;
        } catch (const tandem::shm::Error& error) {
            log_calls_of_orb(error.what());
            return false;
        }
    }
    void expect(const std::string& connection) {
        const std::lock_guard lock(mutex_);
        connections_[connection];
    }
    void end(const std::string& connection) {
        const std::lock_guard lock(mutex_);
        connections_.erase(connection);
    }
    void end_all() {
        const std::lock_guard lock(mutex_);
        connections_.clear();
    }

  private:
    const CORBA::Object_var object_;
    std::mutex mutex_;
    std::map<std::string, std::vector<std::unique_ptr<CallWorkers>>, std::less<>> connections_;
};

SharedCallsOffer::SharedCallsOffer(CORBA::Object_ptr object)
    // The holder's POA has the other reference of the servant.
    : servant_(new Servant(object)), holder_((servant_->_add_ref(), servant_.in())) {}

SharedCallsOffer::~SharedCallsOffer() { servant_->end_all(); }

void SharedCallsOffer::publish(ConnectorProfile& profile, const std::string& provider_key) {
    servant_->expect(static_cast<const char*>(profile.connector_id));
    CORBA_SeqUtil::push_back(profile.properties,
                             NVUtil::newNV(offer_key(provider_key).c_str(), holder_.ior().c_str()));
}

void SharedCallsOffer::end(const std::string& connection) { servant_->end(connection); }

void share_calls_if_possible(CORBA::Object_ptr provider, const std::string& provider_ior,
                             const ConnectorProfile& profile) {
    if (CORBA::is_nil(provider) || !is_in_another_process(provider)) return;
    try {
        const CORBA::Object_var offer = find_offer(profile.properties, provider_ior);
        if (CORBA::is_nil(offer.in()) || !address_on_another_machine(offer.in()).empty()) return;
        const TandemRtm::SharedCalls_var calls = TandemRtm::SharedCalls::_unchecked_narrow(offer.in());
        set_call_timeout(calls.in(), open_timeout);
        auto sender = std::make_shared<CallSender>();
        if (!calls->open(profile.connector_id, sender->link().c_str())) return;
        sender->remove_name();
        send_calls(provider, std::move(sender));
    } catch (const tandem::shm::Error& error) {
        log_calls_of_orb(error.what());
    } catch (const CORBA::SystemException& error) {
        log_calls_of_orb(error._name());
    }
}

} // namespace RTC
