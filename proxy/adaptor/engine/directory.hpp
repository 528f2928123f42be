// SPDX-License-Identifier: Apache-2.0
#pragma once

#ifdef TANDEM_OPROS_PUBLIC_API

class ComponentDirectory;

namespace tandem::adaptor::engine {

/// In a real engine no component learns of the others, or that the engine is ending.
class DirectoryUser {
  protected:
    static ComponentDirectory* directory() { return nullptr; }
    static bool is_ending() { return false; }
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

  private:
    ComponentDirectory* directory_ = nullptr;
};

} // namespace tandem::adaptor::engine

#endif
