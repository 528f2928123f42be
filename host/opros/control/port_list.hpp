// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/execute/component_host.hpp"

#include <PortListener.h>

#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>

namespace tandem::control {

/// The current ports of a component. While they are described, a thread that removes one of them waits. Lists them for
/// other processes (host/process/published/inventory.hpp).
class PortList final : public PortListener {
  public:
    /// Follows the ports of the component until the destruction of this object.
    explicit PortList(engine::ComponentHost& component);
    ~PortList() override;
    PortList(const PortList&) = delete;
    PortList& operator=(const PortList&) = delete;

    /// Returns describe_port() of each port, with its "name". [any-thread]
    nlohmann::json describe() const;

    void portAdded(const std::string& name, Port& port) override;
    void portRemoved(const std::string& name, Port& port) override;

  private:
    void add(const std::string& name, Port& port);
    void remove(const std::string& name);

    engine::ComponentHost& component_;
    mutable std::mutex mutex_; ///< guards ports_; held while a port is used
    std::map<std::string, Port*> ports_;
};

} // namespace tandem::control
