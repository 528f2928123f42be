// SPDX-License-Identifier: Apache-2.0
#include "host/opros/runtime/port/value_pool.hpp"

#include "host/rt/short_mutex.hpp"

#include <array>
#include <atomic>
#include <cstddef>
#include <mutex>
#include <new>

namespace opros {

/// Shared by the pool and the lent values.
struct ValuePool::Slots {
    struct Slot;

    /// The object that the consumer gets. Deleting it, through opros_any's virtual destructor, frees its slot.
    class LentValue final : public opros_any {
      public:
        explicit LentValue(Slot& slot) : slot_(slot) {}
        static void operator delete(LentValue* value, std::destroying_delete_t);
        static void* operator new(std::size_t, void* place) { return place; }

      private:
        Slot& slot_;
    };

    struct Slot {
        std::atomic<bool> lent{false};
        Slots* owner = nullptr;
        opros_any kept; ///< the storage of the last value of this slot
        alignas(LentValue) std::array<std::byte, sizeof(LentValue)> place;
    };

    static constexpr std::size_t count = 4; // further values come from the heap
    std::array<Slot, count> all;
    tandem::rt::ShortMutex mutex; ///< guards giving values back and `abandoned`
    bool abandoned = false;       ///< the pool has been destroyed

    /// Requires the mutex and releases it. Deletes the slots if the pool has gone and no value is lent.
    void unlock_and_release() {
        bool in_use = !abandoned;
        for (const Slot& slot : all) in_use = in_use || slot.lent.load(std::memory_order_relaxed);
        mutex.unlock();
        if (!in_use) delete this;
    }
};

void ValuePool::Slots::LentValue::operator delete(LentValue* value, std::destroying_delete_t) {
    Slot& slot = value->slot_;
    Slots& slots = *slot.owner;
    slots.mutex.lock();
    value->swap(slot.kept); // leaves an empty value, so that nothing has to be destroyed
    slot.lent.store(false, std::memory_order_release);
    if (slots.abandoned) [[unlikely]]
        slots.unlock_and_release();
    else
        slots.mutex.unlock();
}

ValuePool::ValuePool() : slots_(*new Slots) {
    for (Slots::Slot& slot : slots_.all) slot.owner = &slots_;
}

ValuePool::~ValuePool() {
    slots_.mutex.lock();
    slots_.abandoned = true;
    slots_.unlock_and_release();
}

opros_any* ValuePool::lend(opros_any& value) {
    for (Slots::Slot& slot : slots_.all) {
        if (slot.lent.load(std::memory_order_acquire)) continue;
        slot.lent.store(true, std::memory_order_relaxed);
        auto* lent = new (slot.place.data()) Slots::LentValue(slot);
        lent->swap(value);
        value.swap(slot.kept);
        return lent;
    }
    auto* lent = new opros_any;
    lent->swap(value);
    return lent;
}

} // namespace opros
