// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/protocol/port_table.hpp"
#include "proxy/link/protocol/reply.hpp"
#include "proxy/link/protocol/request.hpp"

#include <RequiredServicePort.h>

#include <map>
#include <shared_mutex>
#include <string>

namespace tandem::adaptor {

/// Mirrors a service port that the peer requires: the peer's calls are executed by the OPRoS service port that
/// is connected here. Methods are found by name and checked by signature; no stub is compiled for them.
class MirrorRequiredPort final : public RequiredServicePort {
  public:
    explicit MirrorRequiredPort(link::Port peer);

    bool isDynamic() const override { return true; }
    /// Called when the host connects this port, or with nullptr disconnects it. Returns an empty string, or
    /// one line naming an operation that the peer requires and the provided port lacks or has otherwise.
    std::string bindProvided(ProvidedServicePort* provided) override;

    /// Name and signature of each method that is provided; empty while nothing is connected. [any-thread]
    std::vector<link::ServiceOperation> operations() const;
    const std::string& port() const { return peer_.name; }

    /// Executes one call of the peer. Failures, thrown exceptions included, are replies. [worker-thread]
    link::Reply serve(const link::Request& request);

  private:
    /// Returns as bindProvided() does.
    std::string collect_signatures(ProvidedServicePort& provided);
    link::Reply invoke(const link::Request& request);

    const link::Port peer_;
    mutable std::shared_mutex
        mutex_; ///< exclusive to bind, shared to serve: no call runs in a port that goes
    ProvidedServicePort* provided_ = nullptr;
    std::map<std::string, std::string> signatures_; ///< by method name
};

} // namespace tandem::adaptor
