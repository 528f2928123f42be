// SPDX-License-Identifier: Apache-2.0
#pragma once

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

/// Mirrors a service port that the peer requires, for an engine of the public API alone: it has a method for each
/// operation whose types cross, and the peer's calls are executed by the methods with which the engine connects them.
/// The archives of the API show whether they have the types of the operation.
class TypedRequiredPort final : public RequiredServicePort {
  public:
    /// `bound` is called when a method was connected; it must not wait.
    explicit TypedRequiredPort(
        const link::Port& peer, std::function<void()> bound = [] {}, const PeerNames& names = {});

    /// Name and signature of each operation that is provided; empty while nothing is connected. [any-thread]
    std::vector<link::ServiceOperation> operations() const;
    const std::string& port() const { return port_; }

    /// Executes one call of the peer. Failures, thrown exceptions included, are replies. [worker-thread]
    link::Reply serve(const link::Request& request);
    /// The same by ids, into `memory`; nothing for those that it does not know.
    std::optional<link::ReplyView> serve_known(const link::KnownRequest& request,
                                               wire::MessageBuffer& memory);

  private:
    class Operation;

    const std::string port_;
    const std::function<void()> bound_;
    std::map<std::string, Operation*, std::less<>> operations_; ///< by the peer's names; methods of this port
};

} // namespace tandem::adaptor
