// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/execute/component_host.hpp"

#include <ComponentDirectory.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <vector>

namespace tandem::engine {

/// The directory of an application, for components that show others elsewhere. [any-thread] all functions but the
/// constructor.
class ApplicationDirectory final : public ComponentDirectory {
  public:
    /// The list is read at each call and must not change from the first one on.
    explicit ApplicationDirectory(const std::vector<std::unique_ptr<ComponentHost>>& components)
        : components_(components) {}

    std::vector<std::string> names() const override;
    Component* find(const std::string& name) override;
    std::string type(const std::string& name) const override;
    std::string transition(const std::string& name, ComponentTransition transition) override;
    bool setProperty(const std::string& component, const std::string& name,
                     const std::string& value) override;

    /// Before this all transitions are refused.
    void open() { refusal_ = nullptr; }
    /// Refuses all transitions from now on, and waits for those under way. False if that takes longer than `timeout`.
    bool close(std::chrono::nanoseconds timeout);

  private:
    ComponentHost* find_host(const std::string& name) const;

    const std::vector<std::unique_ptr<ComponentHost>>& components_;
    std::atomic<const char*> refusal_{"the application has not started yet"}; ///< NULL: transitions are made
    std::atomic<int> transitions_{0};                                         ///< under way
};

} // namespace tandem::engine
