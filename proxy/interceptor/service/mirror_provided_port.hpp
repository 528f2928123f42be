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

/// Mirrors a service interface that the RTC provides and OPRoS components require: a CORBA consumer that executes calls
/// from across the link on the RTC's object. No stub is compiled: arguments and results are converted by type signature.
class MirrorProvidedPort final {
  public:
    MirrorProvidedPort(link::Port port, std::chrono::milliseconds call_timeout);

    /// Returns the consumer that a CorbaPort registers; it receives the RTC's object reference at connection.
    RTC::CorbaConsumerBase& consumer() { return consumer_; }
    const link::Port& port() const { return port_; }
    /// Makes calls fail for this reason while the RTC's port is not connected; not if it is empty. [any-thread]
    void leave_out(const std::string& why);
    /// Executes one call of the peer. Failures are replies. [worker-thread]
    link::Reply serve(const link::Request& request);
    /// Executes a call by its ids, with the reply in `memory`; returns nothing for unknown ids.
    std::optional<link::ReplyView> serve_known(const link::KnownRequest& request,
                                               wire::MessageBuffer& memory);

  private:
    /// Returns the operation, or nullptr with the reason in `refusal`.
    const wire::Operation* find_operation(const link::Request& request, link::Reply& refusal);
    const wire::Operation* parse_request_types(std::string_view signature, link::Reply& refusal);
    link::ReplyView invoke(const std::string& name, std::span<const std::byte> arguments,
                           const wire::Operation& operation, wire::MessageBuffer& memory);
    std::string why_left_out();

    const link::Port port_;
    const link::OperationTable operations_;
    std::vector<std::pair<std::uint64_t, const link::KnownOperation*>> known_; ///< the operations by id
    const std::chrono::milliseconds call_timeout_;
    ProviderReference consumer_;
    std::mutex mutex_; ///< guards the two below
    std::string left_out_;
    /// The types from the peer's requests, by signature; used if the IDL is unknown. Entries are never removed.
    std::map<std::string, std::unique_ptr<wire::Operation>, std::less<>> requested_types_;
};

} // namespace tandem::interceptor
