// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/archive/refusal_record.hpp"
#include "proxy/adaptor/names/peer_names.hpp"
#include "proxy/adaptor/service/method_types.hpp"
#include "proxy/link/protocol/operation_table.hpp"
#include "proxy/link/protocol/reply.hpp"
#include "proxy/link/protocol/request.hpp"

#include <ProvidedMethodInterface.h>
#include <RequiredServicePort.h>

#include <functional>
#include <map>
#include <optional>
#include <shared_mutex>
#include <span>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// Mirrors a service port that the peer requires. The connected OPRoS service port executes the peer's calls. Methods are
/// found by name and checked by signature; no stub is compiled.
class MirrorRequiredPort final : public RequiredServicePort, public RefusalRecord {
  public:
    /// `bound` is called when another port was connected; it must not wait.
    explicit MirrorRequiredPort(
        link::Port peer, std::function<void()> bound = [] {}, PeerNames names = {});

    bool isDynamic() const override { return true; }
    /// Called when the host connects this port, or with nullptr disconnects it. Returns an empty string, or one line if the
    /// provided port has none of the operations that the peer requires. Logs a line for each operation that the port lacks.
    std::string bindProvided(ProvidedServicePort* provided) override;

    /// Returns name and signature of each operation that is provided; empty while nothing is connected. [any-thread]
    std::vector<link::ServiceOperation> operations() const;
    const std::string& port() const { return peer_.name; }

    /// Executes one call of the peer. Failures, including thrown exceptions, are replies. [worker-thread]
    link::Reply serve(const link::Request& request);
    /// Executes a call by its ids, with the reply in `memory`; returns nothing for unknown ids.
    std::optional<link::ReplyView> serve_known(const link::KnownRequest& request,
                                               wire::MessageBuffer& memory);

  private:
    /// An operation of the peer and the method that is called for it.
    struct Binding {
        std::string method;
        ProvidedMethodInterface* callee = nullptr; ///< of the connected port; may be null
        wire::Operation types;
        Directions directions;
        std::optional<wire::Type> pictures; ///< the request, if picture_error() must check it
    };
    // Each fills bindings_ or problems_.
    void bind_methods(ProvidedServicePort& provided);
    void bind_method(const std::string& name, Method& method);
    void suggest_methods(ProvidedServicePort& provided);
    void log_missing_operations();
    std::string describe_problems() const;
    void make_known();
    link::ReplyView invoke(std::span<const std::byte> arguments, const Binding& binding,
                           wire::MessageBuffer& memory);

    const link::Port peer_;
    const link::OperationTable required_;
    const std::function<void()> bound_;
    const PeerNames names_;
    mutable std::shared_mutex
        mutex_; ///< exclusive while binding, shared while serving, so no call runs in a port that is being removed
    ProvidedServicePort* provided_ = nullptr;
    std::map<std::string, Binding, std::less<>> bindings_;        ///< by operation
    std::vector<std::pair<std::uint64_t, const Binding*>> known_; ///< the bindings by id
    std::map<std::string, std::string, std::less<>>
        problems_; ///< by operation: why it has no binding, one line
};

} // namespace tandem::adaptor
