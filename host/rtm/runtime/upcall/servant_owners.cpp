// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/upcall/servant_owners.hpp"
#include "host/crash/callback_scope.hpp"
#include <mutex>
#include <omniORB4/callDescriptor.h>
#include <shared_mutex>
#include <unordered_map>

namespace RTC {
namespace {

using Owner = std::shared_ptr<const ServantOwner>;

struct Registry {
    std::shared_mutex mutex;
    std::unordered_map<const omniServant*, Owner> owners;
};

// Never deleted: threads of the ORB may outlive static objects.
Registry& registry() {
    static auto* the_registry = new Registry;
    return *the_registry;
}

// [ORB thread, or the thread of a call within the process]
void call_by_name(omniCallDescriptor* call, omniServant* servant) {
    // Held during the call: its texts are those of the scope, and the component may end meanwhile.
    const Owner owner = find_servant_owner(servant);
    if (owner == nullptr) {
        call->interceptedCall(servant);
        return;
    }
    const tandem::crash::CallbackScope scope(nullptr, owner->component.c_str(), call->op(), owner->code);
    call->interceptedCall(servant);
}

} // namespace

void name_upcalls() { omniCallDescriptor::addInterceptor(call_by_name); }

void set_servant_owner(const omniServant* servant, std::shared_ptr<const ServantOwner> owner) {
    const std::unique_lock lock(registry().mutex);
    if (owner == nullptr)
        registry().owners.erase(servant);
    else
        registry().owners[servant] = std::move(owner);
}

std::shared_ptr<const ServantOwner> find_servant_owner(const omniServant* servant) {
    const std::shared_lock lock(registry().mutex);
    const auto found = registry().owners.find(servant);
    return found == registry().owners.end() ? nullptr : found->second;
}

} // namespace RTC
