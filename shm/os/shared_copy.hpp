// SPDX-License-Identifier: Apache-2.0
// Copies between private memory and memory that another process may be changing at the same moment.
//
// The copies go word by word, with acquire loads and release stores. On x86-64 these are plain moves. A torn copy is a
// wrong value and not undefined behaviour. A thread that has read one word of a write also sees everything that the writer
// did before that write; rings rely on this (ring_producer.hpp).
#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace tandem::shm {

constexpr std::size_t word_bytes = 8;

constexpr std::size_t round_up(std::size_t value, std::size_t multiple) {
    return (value + multiple - 1) / multiple * multiple;
}

inline std::uint64_t load_word(const void* shared) {
    auto* word = static_cast<std::uint64_t*>(const_cast<void*>(shared));
    return std::atomic_ref<std::uint64_t>(*word).load(std::memory_order_acquire);
}

inline void store_word(void* shared, std::uint64_t value) {
    std::atomic_ref<std::uint64_t>(*static_cast<std::uint64_t*>(shared))
        .store(value, std::memory_order_release);
}

/// Copies `bytes` out of shared memory, which is 8-aligned and readable up to the next multiple of 8.
inline void copy_from_shared(void* to, const void* shared, std::size_t bytes) {
    auto* out = static_cast<std::byte*>(to);
    const auto* in = static_cast<const std::byte*>(shared);
    for (; bytes >= word_bytes; bytes -= word_bytes, out += word_bytes, in += word_bytes) {
        const std::uint64_t word = load_word(in);
        std::memcpy(out, &word, word_bytes);
    }
    if (bytes != 0) {
        const std::uint64_t word = load_word(in);
        std::memcpy(out, &word, bytes);
    }
}

/// Copies `bytes` into shared memory, which is 8-aligned and writable up to the next multiple of 8. Fills the rest of the
/// last word with zeros.
inline void copy_to_shared(void* shared, const void* from, std::size_t bytes) {
    auto* out = static_cast<std::byte*>(shared);
    const auto* in = static_cast<const std::byte*>(from);
    for (; bytes >= word_bytes; bytes -= word_bytes, out += word_bytes, in += word_bytes) {
        std::uint64_t word = 0;
        std::memcpy(&word, in, word_bytes);
        store_word(out, word);
    }
    if (bytes != 0) {
        std::uint64_t word = 0;
        std::memcpy(&word, in, bytes);
        store_word(out, word);
    }
}

} // namespace tandem::shm
