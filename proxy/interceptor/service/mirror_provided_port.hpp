// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"
#include "proxy/link/protocol/reply.hpp"
#include "proxy/link/protocol/request.hpp"
#include "proxy/wire/type.hpp"

#include <rtm/CorbaConsumer.h>

#include <chrono>
#include <map>
#include <mutex>
#include <string>

namespace tandem::interceptor {

/// Mirrors a service interface that the RTC provides and OPRoS components require: a CORBA consumer of it, on
/// whose object the calls from across the link are executed. No stub is compiled: arguments and results are
/// converted by type signature.
class MirrorProvidedPort final {
  public:
    MirrorProvidedPort(link::Port port, std::chrono::milliseconds call_timeout);

    /// What a CorbaPort registers; it receives the RTC's object reference at connection.
    RTC::CorbaConsumerBase& consumer() { return consumer_; }
    const link::Port& port() const { return port_; }
    /// Executes one call of the peer. Failures are replies. [worker-thread]
    link::Reply serve(const link::Request& request);

  private:
    struct Types {
        wire::Type arguments, result;
    };
    const Types& parsed_types(std::string_view signature);
    /// Returns why the call is refused, in one line; empty when the operation fits.
    std::string check_operation(const link::Request& request) const;

    const link::Port port_;
    const std::chrono::milliseconds call_timeout_;
    RTC::CorbaConsumerBase consumer_;
    std::mutex mutex_;
    std::map<std::string, Types, std::less<>>
        types_; ///< by signature, parsed once; entries are never removed
};

} // namespace tandem::interceptor
