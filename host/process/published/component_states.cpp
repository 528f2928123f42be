// SPDX-License-Identifier: Apache-2.0
#include "host/process/published/component_states.hpp"

#include "host/process/published/memory_file.hpp"

#include <atomic>
#include <mutex>

namespace tandem::process {
namespace {

MemoryFileOfProcess<ComponentStates>& states_file() {
    static auto* const file = new MemoryFileOfProcess<ComponentStates>;
    return *file;
}

} // namespace

OwnComponentState::OwnComponentState(const std::string& name, ComponentState state) {
    auto& file = states_file();
    const std::lock_guard lock(file.mutex);
    if (file.content == nullptr) return;
    for (auto& place : file.content->place)
        if (place_ == nullptr && std::atomic_ref(place.state).load(std::memory_order_acquire) == 0)
            place_ = &place;
    if (place_ == nullptr) {
        left_out_ = true;
        std::atomic_ref(file.content->left_out).fetch_add(1, std::memory_order_relaxed);
        return;
    }
    place_->in_cycle_since_ns = 0;
    place_->name[name.copy(place_->name, sizeof place_->name - 1)] = '\0';
    set(state);
}

OwnComponentState::~OwnComponentState() {
    const std::lock_guard lock(states_file().mutex);
    set(ComponentState::none);
    if (left_out_) std::atomic_ref(states_file().content->left_out).fetch_sub(1, std::memory_order_relaxed);
}

void OwnComponentState::set(ComponentState state) noexcept {
    if (place_ != nullptr)
        std::atomic_ref(place_->state).store(static_cast<std::uint64_t>(state), std::memory_order_release);
}

void OwnComponentState::set_in_cycle_since(std::int64_t ns) noexcept {
    if (place_ != nullptr) std::atomic_ref(place_->in_cycle_since_ns).store(ns, std::memory_order_relaxed);
}

} // namespace tandem::process
