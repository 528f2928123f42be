// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/link_handler.hpp"
#include "proxy/link/port_table.hpp"
#include "proxy/wire/type.hpp"

#include <rtm/CorbaConsumer.h>

#include <chrono>
#include <map>
#include <mutex>
#include <string>

namespace tandem::interceptor {

/// Mirrors a service that the RTC provides and OPRoS components require: calls that crossed the link are made
/// on the RTC's CORBA object, by type signature.
class MirrorProvidedPort final {
  public:
    MirrorProvidedPort(link::Port port, std::chrono::milliseconds call_timeout);

    RTC::CorbaConsumerBase& consumer() { return consumer_; }
    const link::Port& port() const { return port_; }
    /// Runs one call. [worker-thread]
    link::Reply serve(const link::Request& request);

  private:
    struct Types {
        wire::Type arguments, result;
    };
    const Types& types(std::string_view signature);
    std::string check(const link::Request& request) const;

    const link::Port port_;
    const std::chrono::milliseconds call_timeout_;
    RTC::CorbaConsumerBase consumer_;
    std::mutex mutex_;
    std::map<std::string, Types, std::less<>> types_; ///< parsed once; entries stay where they are
};

} // namespace tandem::interceptor
