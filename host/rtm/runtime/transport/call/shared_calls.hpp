// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/rtm/runtime/transport/cdr_servants.hpp"
#include <memory>
#include <rtm/RTC.h>
#include <string>

namespace RTC {

/// A provider's offer to execute calls that come through shared memory. [any-thread]
class SharedCallsOffer {
  public:
    /// `object`: the provider's.
    explicit SharedCallsOffer(CORBA::Object_ptr object);
    ~SharedCallsOffer();

    /// Publishes the offer for this connection beside the provider's reference, whose key is `provider_key`.
    void publish(ConnectorProfile& profile, const std::string& provider_key);
    /// Executes no more calls of that connection. Does not wait for calls that are being executed.
    void end(const std::string& connection);

  private:
    class Servant;
    PortableServer::Servant_var<Servant> servant_;
    const ServantHolder holder_;
};

/// Makes calls through `provider` use shared memory, if its process is on this machine, has published an offer for it and
/// accepts. `provider_ior`: as in the profile. Otherwise, or if `provider` is nil, changes nothing. Waits up to 10 s.
void share_calls_if_possible(CORBA::Object_ptr provider, const std::string& provider_ior,
                             const ConnectorProfile& profile);

} // namespace RTC
