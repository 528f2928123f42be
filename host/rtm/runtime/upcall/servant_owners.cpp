// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/upcall/servant_owners.hpp"
#include <atomic>
#include <cstdint>
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
    std::atomic<std::uint64_t> changes{0};
};

// Never deleted: threads of the ORB may outlive static objects.
Registry& registry() {
    static auto* the_registry = new Registry;
    return *the_registry;
}

/// The owner that a thread has found last. Usually the thread calls the same servant again, and finds its owner without
/// a lock.
struct LastOwner {
    const omniServant* servant = nullptr;
    std::uint64_t changes = 0; ///< the registry's changes at the time of the lookup
    Owner owner;
    bool in_call =
        false; ///< and so not to be replaced: its texts are those of the scope, and the component may end meanwhile
};

// In static thread storage, so that access needs no function call.
[[gnu::tls_model("initial-exec")]] constinit thread_local LastOwner* last_of_this_thread = nullptr;

LastOwner& make_last_owner() {
    static thread_local LastOwner of_this_thread;
    last_of_this_thread = &of_this_thread;
    return of_this_thread;
}

void call_in_scope(omniCallDescriptor* call, omniServant* servant, const ServantOwner* owner) {
    const UpcallScope scope(owner, call->op());
    call->interceptedCall(servant);
}

struct InCall {
    explicit InCall(LastOwner& last) : last_(last) { last_.in_call = true; }
    ~InCall() { last_.in_call = false; }
    InCall(const InCall&) = delete;
    InCall& operator=(const InCall&) = delete;
    LastOwner& last_;
};

// [ORB thread, or the thread of a call within the process]
void call_by_name(omniCallDescriptor* call, omniServant* servant) {
    LastOwner& last = last_of_this_thread ? *last_of_this_thread : make_last_owner();
    if (last.in_call) [[unlikely]] { // a call within a call
        const Owner owner = find_servant_owner(servant);
        return call_in_scope(call, servant, owner.get());
    }
    const std::uint64_t changes = registry().changes.load(std::memory_order_acquire);
    if (last.servant != servant || last.changes != changes) [[unlikely]] {
        last.owner = find_servant_owner(servant);
        last.servant = servant;
        last.changes = changes;
    }
    const InCall in_call(last);
    call_in_scope(call, servant, last.owner.get());
}

} // namespace

void name_upcalls() { omniCallDescriptor::addInterceptor(call_by_name); }

void set_servant_owner(const omniServant* servant, std::shared_ptr<const ServantOwner> owner) {
    const std::unique_lock lock(registry().mutex);
    if (owner == nullptr)
        registry().owners.erase(servant);
    else
        registry().owners[servant] = std::move(owner);
    registry().changes.fetch_add(1, std::memory_order_release);
}

std::shared_ptr<const ServantOwner> find_servant_owner(const omniServant* servant) {
    const std::shared_lock lock(registry().mutex);
    const auto found = registry().owners.find(servant);
    return found == registry().owners.end() ? nullptr : found->second;
}

} // namespace RTC
