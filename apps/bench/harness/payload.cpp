// SPDX-License-Identifier: Apache-2.0
#include "apps/bench/harness/payload.hpp"

#include <fmt/format.h>

// Large messages are filled and summed with the widest vectors of the machine (chosen when the program starts),
// so that the memory is the limit and not this loop. The sanitizers do not support the dispatch.
#if defined(__x86_64__) && !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
#define TANDEM_BENCH_WIDE __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define TANDEM_BENCH_WIDE
#endif

namespace tandem::bench::detail {

// clang refuses the attribute at the definition of a function that was declared without it.
namespace {
TANDEM_BENCH_WIDE void fill_wide(std::uint64_t* words, std::size_t count, std::uint64_t value) {
    fill_words(words, count, value);
}
TANDEM_BENCH_WIDE std::uint64_t sum_wide(const std::uint64_t* words, std::size_t count) {
    return sum_words(words, count);
}
} // namespace

void fill_large(std::uint64_t* words, std::size_t count, std::uint64_t value) {
    fill_wide(words, count, value);
}

std::uint64_t sum_large(const std::uint64_t* words, std::size_t count) { return sum_wide(words, count); }

void throw_out_of_order(std::uint64_t got, std::uint64_t wanted) {
    throw std::runtime_error(
        fmt::format("received message {} instead of {}: messages were lost or reordered", got, wanted));
}

void throw_corrupt(std::uint64_t first, std::uint64_t sum, std::size_t count) {
    throw std::runtime_error(
        fmt::format("a message of {} words is corrupt: first word {}, sum {} instead of {}", count, first,
                    sum, first * count));
}

} // namespace tandem::bench::detail
