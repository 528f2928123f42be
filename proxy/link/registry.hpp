// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/rt/short_mutex.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tandem::link {

/// Objects by name and by number, which threads find while others are added. They are their owner's, and live longer than
/// this object. [any-thread]
template <class T>
class Registry {
  public:
    /// Replaces another object of that name, and another one of that number.
    void add(std::string name, T& object, std::uint64_t id) {
        const std::lock_guard lock(mutex_);
        objects_.insert_or_assign(std::move(name), &object);
        std::erase_if(by_id_, [&](const auto& each) { return each.first == id; });
        by_id_.emplace_back(id, &object);
    }
    /// nullptr if there is none of that name.
    T* find(std::string_view name) const {
        const std::lock_guard lock(mutex_);
        const auto found = objects_.find(name);
        return found == objects_.end() ? nullptr : found->second;
    }
    [[gnu::hot]] T* find(std::uint64_t id) const {
        const std::lock_guard lock(mutex_);
        for (const auto& [number, object] : by_id_)
            if (number == id) return object;
        return nullptr;
    }
    std::vector<T*> all() const { ///< by their names
        const std::lock_guard lock(mutex_);
        std::vector<T*> all;
        for (const auto& [name, object] : objects_) all.push_back(object);
        return all;
    }

  private:
    mutable rt::ShortMutex mutex_;
    std::map<std::string, T*, std::less<>> objects_;
    std::vector<std::pair<std::uint64_t, T*>> by_id_;
};

} // namespace tandem::link
