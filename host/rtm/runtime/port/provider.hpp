// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
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

    /// Calls of the last activation that still run do not hold this up: until the last of them ends, the ORB takes others as
    /// theirs. Throws CORBA::Exception.
    void activate(const std::string& component);
    void deactivate();
    /// After deactivate(): until it is over, 1 s at most. Nothing refers to the servant after that.
    void wait_for_activation();
    const std::string& descriptor() const { return descriptor_; }
    const std::string& ior() const { return ior_; }

  private:
    class Object;
    const std::string descriptor_;
    std::string ior_;
    std::shared_ptr<Object> object_;
    const omniServant* called_ = nullptr; ///< the servant, as set_servant_owner() knows it
};

} // namespace RTC
