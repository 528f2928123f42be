// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "host/crash/callback_scope.hpp"
#include <memory>
#include <omniORB4/CORBA.h>
#include <optional>
#include <string>

namespace RTC {

/// The component that a servant belongs to.
struct ServantOwner {
    std::string component; ///< its instance name
    const void* code;      ///< an address in its library, for the report of a crash
    std::string port{};    ///< its port to which the servant belongs; empty: none
};

/// From now on, wraps each call of a servant with an owner in a CallbackScope of that component, named after the
/// operation. Call it once, before the ORB accepts calls. [main-thread]
void name_upcalls();

/// Assigns calls of the servant to the owner. NULL: to no component, which is the initial state. Set it to NULL before
/// the servant is deleted. [any-thread]
void set_servant_owner(const omniServant* servant, std::shared_ptr<const ServantOwner> owner);
/// Returns the owner, or NULL if there is none. [any-thread]
std::shared_ptr<const ServantOwner> find_servant_owner(const omniServant* servant);

/// [one thread] The same scope for a call that does not come through the ORB. `owner` may be NULL and must outlive the
/// scope.
class UpcallScope {
  public:
    UpcallScope(const ServantOwner* owner, const char* operation) {
        if (owner == nullptr) return;
        scope_.emplace(nullptr, owner->component.c_str(), operation, owner->code);
        if (!owner->port.empty()) port_.emplace(owner->port.c_str());
    }

  private:
    std::optional<tandem::crash::CallbackScope> scope_;
    std::optional<tandem::crash::PortScope> port_;
};

} // namespace RTC
