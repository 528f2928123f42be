// SPDX-License-Identifier: Apache-2.0
#include "host/opros/runtime/port/value_pool.hpp"

#include <array>
#include <atomic>
#include <cstddef>
#include <new>

namespace opros {
namespace {

enum class State { free, lent, abandoned }; // abandoned: the pool is gone, and the value may still be lent

struct Slot;

/// What the consumer gets. Deleting it, through opros_any's virtual destructor, empties the slot it lives in.
class LentValue final : public opros_any {
  public:
    explicit LentValue(Slot& slot) : slot_(slot) {}
    ~LentValue() override;
    static void operator delete(LentValue* value, std::destroying_delete_t);
    static void* operator new(std::size_t, void* place) { return place; }

  private:
    Slot& slot_;
};

struct Slot {
    std::atomic<State> state{State::free};
    ValuePool::Slots* owner = nullptr;
    opros_any kept; ///< the storage of the value that was here last
    alignas(LentValue) std::array<std::byte, sizeof(LentValue)> place;
};

} // namespace

/// Shared by the pool and the values that are lent.
struct ValuePool::Slots {
    static constexpr std::size_t count = 4; // a consumer that keeps more values gets others from the heap
    std::array<Slot, count> all;
    std::atomic<std::size_t> references{count + 1}; // of each slot, and of the pool
    void release(std::size_t n) {
        if (references.fetch_sub(n, std::memory_order_acq_rel) == n) delete this;
    }
};

namespace {

[[gnu::hot]] LentValue::~LentValue() { swap(slot_.kept); }

[[gnu::hot]] void LentValue::operator delete(LentValue* value, std::destroying_delete_t) {
    Slot& slot = value->slot_;
    value->~LentValue();
    if (slot.state.exchange(State::free, std::memory_order_acq_rel) == State::abandoned)
        slot.owner->release(1);
}

} // namespace

ValuePool::ValuePool() : slots_(*new Slots) {
    for (Slot& slot : slots_.all) slot.owner = &slots_;
}

ValuePool::~ValuePool() {
    std::size_t released = 1;
    for (Slot& slot : slots_.all)
        if (slot.state.exchange(State::abandoned, std::memory_order_acq_rel) == State::free) ++released;
    slots_.release(released);
}

[[gnu::hot]] opros_any* ValuePool::lend(opros_any& value) {
    for (Slot& slot : slots_.all) {
        if (slot.state.load(std::memory_order_acquire) != State::free) continue;
        slot.state.store(State::lent, std::memory_order_relaxed);
        auto* lent = new (slot.place.data()) LentValue(slot);
        lent->swap(value);
        value.swap(slot.kept);
        return lent;
    }
    auto* lent = new opros_any;
    lent->swap(value);
    return lent;
}

} // namespace opros
