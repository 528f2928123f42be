// SPDX-License-Identifier: Apache-2.0
// One access of one thread to shared memory, and when two of them depend on each other.
#pragma once
#include "tests/shm/model/checker/memory.hpp"

#include <source_location>
#include <string>
#include <string_view>

namespace tandem::shm::model {

using Site = std::source_location;

/// end: the thread dies here. resume: goes on after pause(). expire: gives up a futex_wait at its deadline.
enum class Kind : std::uint8_t { load, store, change, fence, sleep, wake, expire, resume, end };

inline const char* name_of(Kind kind) {
    constexpr const char* names[] = {"load", "store",  "change", "fence",    "sleep",
                                     "wake", "expire", "resume", "is killed"};
    return names[static_cast<std::size_t>(kind)];
}

constexpr std::uint32_t no_location = ~std::uint32_t{0};
/// Locations that are not words: the sleepers on a word, the life of a process.
constexpr std::uint32_t queue_of(std::uint32_t word) { return 2 * max_locations + word; }
constexpr std::uint32_t life_of(std::uint32_t group) { return max_locations + group; }

struct Operation {
    Kind kind = Kind::resume;
    Order order = Order::relaxed;
    std::uint32_t location = no_location; ///< the word
    std::uint32_t queue = no_location;    ///< the sleepers of a futex word, for sleep, wake and expire
    std::uint8_t group = 0;               ///< of end: the process that dies

    bool writes_word() const { return kind == Kind::store || kind == Kind::change || kind == Kind::end; }
    bool is_fence() const { return kind == Kind::fence; }
    bool in_total_order() const { return is_fence() || sequential(order); }
    /// Changes nothing but its own thread, and after a later store may still read what it could read before.
    bool is_plain_look() const { return kind == Kind::load && !sequential(order); }
};

/// `moved`: one of the two has raised the bound of seq_cst loads of the word. Conservative where it is not
/// exact: operations that are called dependent are only explored in both orders.
inline bool dependent(const Operation& a, const Operation& b, bool moved) {
    if (a.queue != no_location && a.queue == b.queue) return true;
    if (a.location != no_location && a.location == b.location) {
        if (a.writes_word() || b.writes_word()) return true;
        if (moved && a.in_total_order() && b.in_total_order()) return true;
    }
    return (a.is_fence() && b.in_total_order()) || (b.is_fence() && a.in_total_order());
}

inline const char* name_of(Order order) {
    constexpr const char* names[] = {"relaxed", "consume", "acquire", "release", "acq_rel", "seq_cst"};
    return names[static_cast<std::size_t>(order)];
}

inline std::string name_of(const Site& site) {
    std::string_view file = site.file_name();
    const auto cut = file.rfind('/');
    if (cut != std::string_view::npos) file.remove_prefix(cut + 1);
    return std::string(file) + ":" + std::to_string(site.line());
}

} // namespace tandem::shm::model
