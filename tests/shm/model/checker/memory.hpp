// SPDX-License-Identifier: Apache-2.0
// The memory model: what a load may see, and what a thread knows afterwards. (The rules: model.hpp.)
#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace tandem::shm::model {

constexpr std::size_t max_threads = 6; ///< the main thread, number 0, included
constexpr std::size_t max_locations = 320;

using Order = std::memory_order;
using Index = std::uint16_t; ///< place in a location's modification order

constexpr bool acquires(Order order) {
    return order == Order::acquire || order == Order::consume || order == Order::acq_rel ||
           order == Order::seq_cst;
}
constexpr bool releases(Order order) {
    return order == Order::release || order == Order::acq_rel || order == Order::seq_cst;
}
constexpr bool sequential(Order order) { return order == Order::seq_cst; }

/// Per location, the newest store that is known: nothing older may be read.
struct Seen {
    std::array<Index, max_locations> index{};

    void join(const Seen& other, std::size_t locations) {
        for (std::size_t i = 0; i < locations; ++i) index[i] = std::max(index[i], other.index[i]);
    }
};

/// The knowledge of a thread: stores, and how far each thread had come (for plain accesses).
struct View {
    Seen seen;
    std::array<std::uint32_t, max_threads> clock{};

    void join(const View& other, std::size_t locations) {
        seen.join(other.seen, locations);
        for (std::size_t i = 0; i < max_threads; ++i) clock[i] = std::max(clock[i], other.clock[i]);
    }
};

struct Store {
    std::uint64_t value;
    std::int32_t message; ///< what an acquiring reader learns: an index of Memory::messages_, -1 = nothing
    std::uint64_t time;
    std::array<std::uint32_t, max_threads> knows; ///< the writer's clock
};

struct Location {
    std::vector<Store> stores; ///< modification order, which is the order of execution
    Index sequential = 0; ///< newest store that a seq_cst access has written or read, or a fence passed on
    /// The clock of each thread's last access of each sort; 0 = none.
    std::array<std::uint32_t, max_threads> read{}, write{}, plain_read{}, plain_write{};
};

/// The part of a thread's state that the memory model keeps.
struct Observer {
    View now;            ///< what happens-before the next step
    View on_acquire;     ///< what relaxed loads have seen: counts from the next acquire fence on
    View on_release;     ///< as of the last release fence: what relaxed stores publish
    bool fenced = false; ///< there was one
    std::uint64_t time = 0;
};

class Memory {
  public:
    void clear() {
        for (std::size_t i = 0; i < used_; ++i) reset(locations_[i]);
        used_ = 0;
        message_count_ = 0;
    }

    std::uint32_t add(std::uint64_t value) {
        if (used_ == max_locations) throw std::logic_error("model: more than max_locations words");
        if (locations_.size() <= used_) locations_.emplace_back();
        locations_[used_].stores.push_back({value, -1, 0, {}});
        return static_cast<std::uint32_t>(used_++);
    }

    const Location& at(std::uint32_t location) const { return locations_[location]; }
    Index newest(std::uint32_t location) const {
        return static_cast<Index>(locations_[location].stores.size() - 1);
    }
    std::size_t used() const { return used_; }

    /// The oldest store that the observer may still read.
    Index oldest_readable(const Observer& who, std::uint32_t location, Order order) const {
        const Index own = who.now.seen.index[location];
        return sequential(order) ? std::max(own, locations_[location].sequential) : own;
    }

    std::uint64_t read(Observer& who, std::uint32_t location, Index index, Order order) {
        Location& place = locations_[location];
        const Store& store = place.stores[index];
        Index& seen = who.now.seen.index[location];
        seen = std::max(seen, index);
        if (store.message >= 0)
            (acquires(order) ? who.now : who.on_acquire).join(messages_[store.message], used_);
        if (sequential(order)) place.sequential = std::max(place.sequential, index);
        who.time = std::max(who.time, store.time);
        return store.value;
    }

    /// `after`: the store that a read-modify-write has read, whose release sequence this continues; or -1.
    void write(Observer& who, std::uint32_t location, std::uint64_t value, Order order, int after = -1) {
        Location& place = locations_[location];
        const auto index = static_cast<Index>(place.stores.size());
        who.now.seen.index[location] = index;
        if (who.fenced) who.on_release.seen.index[location] = index;
        const std::int32_t earlier = after >= 0 ? place.stores[after].message : -1;
        std::int32_t message = earlier;
        if (releases(order) || who.fenced) {
            message = new_message(releases(order) ? who.now : who.on_release);
            if (earlier >= 0) messages_[message].join(messages_[earlier], used_);
        }
        place.stores.push_back({value, message, who.time, who.now.clock});
        if (sequential(order)) place.sequential = index;
    }

    /// A seq_cst fence: acquire, release, and the exchange of what all such fences have seen.
    void fence(Observer& who) {
        who.now.join(who.on_acquire, used_);
        for (std::size_t i = 0; i < used_; ++i) {
            Index& mine = who.now.seen.index[i];
            Index& all = locations_[i].sequential;
            mine = all = std::max(mine, all);
        }
        who.on_release = who.now;
        who.fenced = true;
    }

    /// Models the kernel's barrier in a wake-up: a thread that goes to sleep on the futex word later sees everything that the
    /// waker knows.
    void pass_on(const Observer& who, std::uint32_t location) {
        Index& all = locations_[location].sequential;
        all = std::max(all, who.now.seen.index[location]);
    }

    /// From now on `thread`'s last read of the word counts as a plain one. Returns false if a store
    /// that is already
    /// there did not wait for it.
    bool settle(std::size_t thread, std::uint32_t location, Index read) {
        Location& place = locations_[location];
        place.plain_read[thread] = place.read[thread];
        for (std::size_t i = read + 1U; i < place.stores.size(); ++i)
            if (place.stores[i].knows[thread] < place.read[thread]) return false;
        return true;
    }

    /// Notes an access for the detection of data races. Returns false if it races with an earlier one.
    bool note(const Observer& who, std::size_t thread, std::uint32_t location, bool writes, bool plain) {
        Location& place = locations_[location];
        bool sound = true;
        const auto ordered_after = [&](const std::array<std::uint32_t, max_threads>& others) {
            for (std::size_t i = 0; i < max_threads; ++i)
                if (i != thread && others[i] > who.now.clock[i]) sound = false;
        };
        ordered_after(place.plain_write);
        if (writes) ordered_after(place.plain_read);
        if (plain) ordered_after(place.write);
        if (plain && writes) ordered_after(place.read);
        auto& mine =
            plain ? (writes ? place.plain_write : place.plain_read) : (writes ? place.write : place.read);
        mine[thread] = who.now.clock[thread];
        return sound;
    }

  private:
    static void reset(Location& place) {
        place.stores.clear();
        place.sequential = 0;
        place.read = place.write = place.plain_read = place.plain_write = {};
    }
    std::int32_t new_message(const View& view) {
        if (messages_.size() <= message_count_) messages_.emplace_back();
        messages_[message_count_] = view;
        return static_cast<std::int32_t>(message_count_++);
    }

    std::vector<Location> locations_;
    std::size_t used_ = 0;
    std::vector<View> messages_;
    std::size_t message_count_ = 0;
};

} // namespace tandem::shm::model
