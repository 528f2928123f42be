// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/upcall/servant_owners.hpp"
#include "host/crash/callback_scope.hpp"
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

struct FoundOwner {
    const omniServant* servant = nullptr;
    std::uint64_t changes = 0; ///< of the registry, when it was looked for
    Owner owner;
};

/// A thread mostly calls the same servant again: the owner that it has found last is found without a lock.
FoundOwner& last_owner() {
    thread_local FoundOwner of_this_thread;
    return of_this_thread;
}

/// The owner of a call, held during the call: its texts are those of the scope, and the component may end meanwhile. It is
/// taken out of last_owner() for that time, so that calls within the call cannot replace it.
class OwnerOfCall {
  public:
    explicit OwnerOfCall(const omniServant* servant)
        : last_(last_owner()), servant_(servant),
          changes_(registry().changes.load(std::memory_order_acquire)) {
        if (last_.servant == servant && last_.changes == changes_) {
            owner_ = std::move(last_.owner);
            last_.servant = nullptr;
        } else {
            owner_ = find_servant_owner(servant);
        }
    }
    ~OwnerOfCall() { last_ = {servant_, changes_, std::move(owner_)}; }
    OwnerOfCall(const OwnerOfCall&) = delete;
    OwnerOfCall& operator=(const OwnerOfCall&) = delete;
    const ServantOwner* get() const { return owner_.get(); }

  private:
    FoundOwner& last_;
    const omniServant* const servant_;
    const std::uint64_t changes_;
    Owner owner_;
};

// [ORB thread, or the thread of a call within the process]
void call_by_name(omniCallDescriptor* call, omniServant* servant) {
    const OwnerOfCall found(servant);
    const ServantOwner* const owner = found.get();
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
    registry().changes.fetch_add(1, std::memory_order_release);
}

std::shared_ptr<const ServantOwner> find_servant_owner(const omniServant* servant) {
    const std::shared_lock lock(registry().mutex);
    const auto found = registry().owners.find(servant);
    return found == registry().owners.end() ? nullptr : found->second;
}

} // namespace RTC
