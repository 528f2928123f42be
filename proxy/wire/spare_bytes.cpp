// SPDX-License-Identifier: Apache-2.0
#include "proxy/wire/spare_bytes.hpp"

#include <array>
#include <utility>

namespace tandem::wire {
namespace {

// For a longer message the copies take longer than the allocations.
constexpr std::size_t max_kept_bytes = std::size_t{64} * 1024;

struct Spares {
    std::array<std::vector<std::byte>, 4>
        vectors; ///< the arguments and the reply of a call, and of a nested one
    std::size_t count = 0;
};

Spares& spares() {
    thread_local Spares of_this_thread;
    return of_this_thread;
}

} // namespace

std::vector<std::byte> take_spare_bytes() {
    Spares& all = spares();
    if (all.count == 0) return {};
    return std::move(all.vectors[--all.count]);
}

void give_back(std::vector<std::byte>&& bytes) {
    Spares& all = spares();
    if (bytes.capacity() == 0 || bytes.capacity() > max_kept_bytes || all.count == all.vectors.size()) return;
    all.vectors[all.count++] = std::move(bytes);
}

} // namespace tandem::wire
