// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/transport/call/shared_calls.hpp"
#include <memory>
#include <mutex>
#include <rtm/CorbaPort.h>
#include <string>

namespace RTC {

/// A provided service: a servant that is reachable while its component is active. Its IOR stays the same over
/// all activations, so consumers that got it before find the provider when it is activated. [one thread at a time]
class CorbaPort::Provider {
  public:
    /// Throws CORBA::Exception.
    Provider(const char* type, const char* instance, PortableServer::ServantBase& servant);
    ~Provider();
    Provider(const Provider&) = delete;
    Provider& operator=(const Provider&) = delete;

    /// Activates the provider without waiting for calls of the previous activation. Until the last of these ends, the
    /// ORB treats other calls as calls of the previous activation. Throws CORBA::Exception.
    void activate(const std::string& component, const std::string& port);
    void deactivate();
    /// Waits, after deactivate(), at most 1 s until the activation is over. Afterwards nothing refers to the servant.
    void wait_for_activation();
    /// Offers, under a key beside `key`, to execute calls that come through shared memory.
    void offer_shared_calls(ConnectorProfile& profile, const std::string& key);
    /// Ends the calls through shared memory of a connection, except those that are being executed.
    void end_shared_calls(const std::string& connection);
    const std::string& descriptor() const { return descriptor_; }
    const std::string& ior() const { return ior_; }

  private:
    class Object;
    const std::string descriptor_;
    std::string ior_;
    std::shared_ptr<Object> object_;
    std::mutex offer_mutex_; ///< guards the next one: ports are connected by several ORB threads
    std::unique_ptr<SharedCallsOffer> shared_calls_; ///< from the first connection with another process on
    const omniServant* called_ = nullptr;            ///< the servant, as set_servant_owner() knows it
};

} // namespace RTC
