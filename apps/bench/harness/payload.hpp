// SPDX-License-Identifier: Apache-2.0
// The content of every message: its sequence number in every word. The reader's sum over all words reveals a
// lost, torn or repeated message, and writer and reader touch every byte, as a user's code does. Endpoints know
// the size of a small message at compile time, like the user of a typed port: a loop of unknown length takes 40
// of the 160 ns of a crossing.
#pragma once
#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace tandem::bench {

/// The sequence number of the last message of a case.
constexpr std::uint64_t stop_sequence = ~std::uint64_t{0};

namespace detail {
void fill_large(std::uint64_t* words, std::size_t count, std::uint64_t value);
std::uint64_t sum_large(const std::uint64_t* words, std::size_t count);
[[noreturn]] void throw_out_of_order(std::uint64_t got, std::uint64_t wanted);
[[noreturn]] void throw_corrupt(std::uint64_t first, std::uint64_t sum, std::size_t count);
constexpr std::size_t large_words = 64; // longer ones justify a call of a vectorized function

inline void fill_words(std::uint64_t* words, std::size_t count, std::uint64_t value) {
    for (std::size_t i = 0; i < count; ++i) words[i] = value;
}
inline std::uint64_t sum_words(const std::uint64_t* words, std::size_t count) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += words[i];
    return sum;
}

} // namespace detail

/// Writes the sequence number into all words. `bytes` is a multiple of 8, the memory aligned to 8.
inline void fill_message(void* memory, std::size_t bytes, std::uint64_t sequence) {
    auto* words = static_cast<std::uint64_t*>(memory);
    const std::size_t count = bytes / sizeof(std::uint64_t);
    if (count > detail::large_words) return detail::fill_large(words, count, sequence);
    detail::fill_words(words, count, sequence);
}

/// Returns the message's sequence number. Throws std::runtime_error if its words differ.
inline std::uint64_t checked_sequence(const void* memory, std::size_t bytes) {
    const auto* words = static_cast<const std::uint64_t*>(memory);
    const std::size_t count = bytes / sizeof(std::uint64_t);
    std::uint64_t sum = 0;
    if (count > detail::large_words)
        sum = detail::sum_large(words, count);
    else
        sum = detail::sum_words(words, count);
    if (sum != words[0] * count) detail::throw_corrupt(words[0], sum, count);
    return words[0];
}

} // namespace tandem::bench
