// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/service/provider_reference.hpp"
#include "proxy/link/protocol/operation_table.hpp"
#include "proxy/link/protocol/reply.hpp"
#include "proxy/link/protocol/request.hpp"

#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

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
    /// The same by ids, into `memory`; nothing for those that it does not know.
    std::optional<link::ReplyView> serve_known(const link::KnownRequest& request,
                                               wire::MessageBuffer& memory);

  private:
    /// Finds the operation; otherwise returns nullptr and why the call is refused.
    const wire::Operation* find_operation(const link::Request& request, link::Reply& refusal);
    const wire::Operation* parse_request_types(std::string_view signature, link::Reply& refusal);
    [[gnu::always_inline]] link::ReplyView invoke(const std::string& name,
                                                  std::span<const std::byte> arguments,
                                                  const wire::Operation& operation,
                                                  wire::MessageBuffer& memory);

    const link::Port port_;
    const link::OperationTable operations_;
    std::vector<std::pair<std::uint64_t, const link::KnownOperation*>> known_; ///< the same by id
    const std::chrono::milliseconds call_timeout_;
    ProviderReference consumer_;
    std::mutex mutex_; ///< requested_types_
    /// Without the IDL: what the peer's requests said, by signature; entries are never removed.
    std::map<std::string, std::unique_ptr<wire::Operation>, std::less<>> requested_types_;
};

} // namespace tandem::interceptor
