// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/archive/refusal_record.hpp"
#include "proxy/adaptor/names/peer_names.hpp"
#include "proxy/adaptor/typed/value_type.hpp"
#include "proxy/link/protocol/operation_table.hpp"
#include "proxy/link/protocol/reply.hpp"
#include "proxy/link/protocol/request.hpp"

#include <RequiredServicePort.h>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// Mirrors a service port that the peer requires, for an engine with only the public API. Has a method for each operation
/// whose types cross. The methods that the engine connects with them execute the peer's calls. The archives of the API show
/// whether these methods have the types of the operation.
class TypedRequiredPort final : public RequiredServicePort, public RefusalRecord {
  public:
    /// `bound` is called when a method was connected; it must not wait.
    explicit TypedRequiredPort(
        const link::Port& peer, std::function<void()> bound = [] {}, const PeerNames& names = {});

    /// Returns name and signature of each operation that is provided; empty while nothing is connected. [any-thread]
    std::vector<link::ServiceOperation> operations() const;
    const std::string& port() const { return port_; }

    /// Executes one call of the peer. Failures, including thrown exceptions, are replies. [worker-thread]
    link::Reply serve(const link::Request& request);
    /// Executes a call by its ids, with the reply in `memory`; returns nothing for unknown ids.
    std::optional<link::ReplyView> serve_known(const link::KnownRequest& request,
                                               wire::MessageBuffer& memory);

  private:
    class Operation;

    const std::string port_;
    const std::function<void()> bound_;
    std::map<std::string, Operation*, std::less<>> operations_; ///< by the peer's names; methods of this port
};

} // namespace tandem::adaptor
