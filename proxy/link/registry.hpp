// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tandem::link {

/// Objects by name and by number. Threads look them up while others are added. Each call across the link finds its
/// object by number, without a lock. The owner keeps the objects, which outlive the registry. [any-thread]
template <class T>
class Registry {
  public:
    /// Adds an object. Replaces an earlier object with this name and an earlier object with this number.
    void add(std::string name, T& object, std::uint64_t id) {
        const std::lock_guard lock(mutex_);
        objects_.insert_or_assign(std::move(name), &object);
        for (Numbered& known : numbered_)
            if (known.id == id) return known.object.store(&object, std::memory_order_release);
        const Numbered* const others = first_.load(std::memory_order_relaxed);
        first_.store(&numbered_.emplace_back(id, object, others), std::memory_order_release);
    }
    /// Returns nullptr if no object has this name.
    T* find(std::string_view name) const {
        const std::lock_guard lock(mutex_);
        const auto found = objects_.find(name);
        return found == objects_.end() ? nullptr : found->second;
    }
    T* find(std::uint64_t id) const {
        const auto* at = first_.load(std::memory_order_acquire);
        while (at != nullptr && at->id != id) at = at->next;
        return at == nullptr ? nullptr : at->object.load(std::memory_order_acquire);
    }
    std::vector<T*> all() const { ///< ordered by name
        const std::lock_guard lock(mutex_);
        std::vector<T*> all;
        for (const auto& [name, object] : objects_) all.push_back(object);
        return all;
    }

  private:
    /// Never removed. Only the object changes.
    struct Numbered {
        Numbered(std::uint64_t its_id, T& its_object, const Numbered* others)
            : id(its_id), object(&its_object), next(others) {}
        const std::uint64_t id;
        std::atomic<T*> object;
        const Numbered* const next;
    };

    mutable std::mutex mutex_; ///< guards additions and the names
    std::map<std::string, T*, std::less<>> objects_;
    std::deque<Numbered> numbered_;
    std::atomic<const Numbered*> first_{nullptr};
};

} // namespace tandem::link
