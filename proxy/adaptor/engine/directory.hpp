// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Component.h>

#include <string>

#ifdef TANDEM_OPROS_PUBLIC_API

class ComponentDirectory;

namespace tandem::adaptor::engine {

/// The DirectoryUser of a real engine, which has no directory and does not tell its components that it ends.
class DirectoryUser {
  protected:
    static ComponentDirectory* directory() { return nullptr; }
    static bool is_ending() { return false; }
    /// Takes a component from ERROR to ACTIVE. Returns an empty text, or the reason why not in one line.
    static std::string restart(Component& component) {
        if (component.recover() == OPROS_SUCCESS && component.start() == OPROS_SUCCESS) return "";
        return "its recovery or start has failed";
    }
};

} // namespace tandem::adaptor::engine

#else

#include <ComponentDirectory.h>

namespace tandem::adaptor::engine {

/// A component that gets the directory of its application from the host.
class DirectoryUser : public ComponentDirectoryUser {
  public:
    void setComponentDirectory(ComponentDirectory* directory) override { directory_ = directory; }

  protected:
    ComponentDirectory* directory() const { return directory_; } ///< nullptr: there is none
    bool is_ending() const { return directory_ && directory_->isEnding(); }
    /// Takes a component from ERROR to ACTIVE. Returns an empty text, or the reason why not in one line.
    std::string restart(Component& component) const {
        if (!directory_) {
            if (component.recover() == OPROS_SUCCESS && component.start() == OPROS_SUCCESS) return "";
            return "its recovery or start has failed";
        }
        std::string error = directory_->transition(component.getId(), TRANSITION_RECOVER);
        return error.empty() ? directory_->transition(component.getId(), TRANSITION_START) : error;
    }

  private:
    ComponentDirectory* directory_ = nullptr;
};

} // namespace tandem::adaptor::engine

#endif
