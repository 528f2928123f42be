// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/port/provider.hpp"

#include "host/process/bounded_call.hpp"
#include "host/rtm/runtime/upcall/servant_owners.hpp"
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <rtm/Manager.h>
#include <typeinfo>

namespace RTC {
namespace {

// How long an activation waits for the calls of the previous activation.
constexpr std::chrono::milliseconds short_wait{10};
// How long the end of a component waits for a pending activation: the same time as for the calls of a port.
constexpr std::chrono::seconds last_wait{1};

} // namespace

/// The servant as an object of the POA. A thread that waits in the servant may outlive the provider.
class CorbaPort::Provider::Object {
  public:
    explicit Object(PortableServer::ServantBase& servant)
        : servant_(&servant), poa_(Manager::instance().getShortCutPOA()) {
        // Activates once to get the object id and the IOR. Later activations use this id.
        id_ = poa_->activate_object(servant_);
        reference_ = poa_->id_to_reference(id_.in());
    }

    /// Valid as long as this object, even while it is not active.
    CORBA::Object_ptr reference() const { return reference_.in(); }
    std::string publish() const {
        CORBA::String_var ior = Manager::instance().theORB()->object_to_string(reference_.in());
        poa_->deactivate_object(id_.in());
        return ior.in();
    }

    /// Returns false if it is active or a thread is activating it.
    bool begin_activation() {
        const std::lock_guard lock(mutex_);
        const bool begins = !wanted_ && !waits_;
        wanted_ = true;
        waits_ = waits_ || begins;
        return begins;
    }
    /// Activates an object that was never active, so that no call can be in progress. Returns false for any other
    /// object.
    bool activate_first() {
        if (was_active_) return false;
        was_active_ = true;
        activate();
        return true;
    }
    /// Activates the object. The POA waits until the calls of the previous activation have ended.
    void activate() {
        try {
            poa_->activate_object_with_id(id_.in(), servant_);
        } catch (const CORBA::Exception&) {
            const std::lock_guard lock(mutex_);
            wanted_ = false;
            end_activation();
            throw;
        }
        const std::lock_guard lock(mutex_);
        if (!wanted_) deactivate_object(); // deactivation was requested meanwhile
        end_activation();
    }
    /// Returns false if it was not active.
    bool deactivate() {
        const std::lock_guard lock(mutex_);
        if (!wanted_) return false;
        if (!waits_) deactivate_object();
        wanted_ = false;
        return true;
    }
    /// Waits for a pending activation. The servant may be deleted afterwards.
    void wait_for_activation() {
        std::unique_lock lock(mutex_);
        activated_.wait_for(lock, last_wait, [this] { return !waits_; });
    }
    PortableServer::ServantBase& servant() { return *servant_; }

  private:
    void end_activation() {
        waits_ = false;
        activated_.notify_all();
    }
    void deactivate_object() {
        try {
            poa_->deactivate_object(id_.in());
        } catch (const CORBA::Exception&) {
            // The ORB was shut down first: nothing is left to deactivate.
        }
    }

    PortableServer::ServantBase* const servant_;
    const PortableServer::POA_var poa_;
    PortableServer::ObjectId_var id_;
    CORBA::Object_var reference_;
    std::mutex mutex_; ///< guards the three members below, and deactivations
    std::condition_variable activated_;
    bool wanted_ = false; ///< it is active, or will be when the thread has activated it
    bool waits_ = false;  ///< a thread is activating it
    bool was_active_ = false;
};

CorbaPort::Provider::Provider(const char* type, const char* instance, PortableServer::ServantBase& servant)
    : descriptor_(std::string(type) + "." + instance), object_(std::make_shared<Object>(servant)) {
    ior_ = object_->publish();
}

CorbaPort::Provider::~Provider() { deactivate(); }

void CorbaPort::Provider::activate(const std::string& component, const std::string& port) {
    auto& servant = object_->servant();
    called_ = &servant;
    set_servant_owner(called_,
                      std::make_shared<ServantOwner>(ServantOwner{component, &typeid(servant), port}));
    if (object_->begin_activation() && !object_->activate_first())
        tandem::process::BoundedCall::returns_within(short_wait, [object = object_] { object->activate(); });
}

void CorbaPort::Provider::deactivate() {
    if (object_->deactivate()) set_servant_owner(called_, nullptr);
}

void CorbaPort::Provider::offer_shared_calls(ConnectorProfile& profile, const std::string& key) {
    const std::lock_guard lock(offer_mutex_);
    if (!shared_calls_) shared_calls_ = std::make_unique<SharedCallsOffer>(object_->reference());
    shared_calls_->publish(profile, key);
}
void CorbaPort::Provider::end_shared_calls(const std::string& connection) {
    const std::lock_guard lock(offer_mutex_);
    if (shared_calls_) shared_calls_->end(connection);
}

void CorbaPort::Provider::wait_for_activation() { object_->wait_for_activation(); }

} // namespace RTC
