// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/link_handler.hpp"
#include "proxy/link/port_table.hpp"

#include <RequiredServicePort.h>

#include <map>
#include <shared_mutex>
#include <string>

namespace tandem::adaptor {

/// Mirrors a service port that the peer requires: the peer's calls are made on the OPRoS port connected
/// here, by whatever methods it provides.
class MirrorRequiredPort final : public RequiredServicePort {
  public:
    explicit MirrorRequiredPort(link::Port peer);

    bool isDynamic() const override { return true; }
    /// At connection: every operation that the peer requires must be there with its signature.
    std::string bindProvided(ProvidedServicePort* provided) override;

    /// Name and signature of what is provided; empty while nothing is connected.
    std::vector<link::ServiceOperation> operations() const;
    const std::string& port() const { return peer_.name; }

    /// Runs one call. [worker-thread]
    link::Reply serve(const link::Request& request);

  private:
    std::string collect(ProvidedServicePort& provided);
    link::Reply invoke(const link::Request& request);

    const link::Port peer_;
    mutable std::shared_mutex mutex_; ///< taken alone to bind, so that no call runs in a port that is going
    ProvidedServicePort* provided_ = nullptr;
    std::map<std::string, std::string> signatures_;
};

} // namespace tandem::adaptor
