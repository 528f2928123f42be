// SPDX-License-Identifier: Apache-2.0
// Deliberate damage to the code under test: one access, known by its place in the source, does less than it
// says.
#pragma once
#include "tests/shm/model/checker/operation.hpp"

#include <cstring>
#include <map>
#include <tuple>

namespace tandem::shm::model {

enum class Damage {
    weaker_order,   ///< of a load, a store, a read-modify-write, or the success of a compare-exchange
    weaker_failure, ///< the order of a compare-exchange that fails
    no_comparison,  ///< a compare-exchange stores and reports success whatever it finds
    no_store,       ///< a store, or the storing half of a read-modify-write, does not happen
    no_fence,
    no_wake
};

struct Place {
    std::string file;
    std::uint32_t line, column;
    auto key() const { return std::tie(file, line, column); }
    bool operator<(const Place& other) const { return key() < other.key(); }
    bool is(const Site& site) const {
        return line == site.line() && column == site.column() && file == site.file_name();
    }
};

struct Mutation {
    Place place;
    Damage damage;
    Order order = Order::relaxed; ///< what is left of it
};

enum class Access { load, store, change, compare, fence, wake };

/// The accesses that a run has seen, with the strongest orders they were made with.
struct AccessLog {
    struct Entry {
        Access access;
        Order order, failure;
    };
    std::map<Place, Entry> entries;

    void note(const Site& site, Access access, Order order, Order failure = Order::relaxed) {
        entries.try_emplace(Place{site.file_name(), site.line(), site.column()},
                            Entry{access, order, failure});
    }
};

} // namespace tandem::shm::model
