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
};

/// From now on a call of a servant with an owner is a CallbackScope of that component, named after the operation. Once, before
/// the ORB takes calls. [main-thread]
void name_upcalls();

/// Calls of the servant belong to the owner; NULL: to nobody, as before. To be set to NULL before the servant is deleted.
/// [any-thread]
void set_servant_owner(const omniServant* servant, std::shared_ptr<const ServantOwner> owner);
/// NULL: none. [any-thread]
std::shared_ptr<const ServantOwner> find_servant_owner(const omniServant* servant);

/// [one thread] The same scope around a call that does not come through the ORB. `owner` may be NULL, and outlives it.
class UpcallScope {
  public:
    UpcallScope(const ServantOwner* owner, const char* operation) {
        if (owner != nullptr) scope_.emplace(nullptr, owner->component.c_str(), operation, owner->code);
    }

  private:
    std::optional<tandem::crash::CallbackScope> scope_;
};

} // namespace RTC
