// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shm/segment/layout.hpp"

#include <array>
#include <bit>
#include <initializer_list>

namespace tandem::shm {

/// A set of doorbell bits. Bit numbers are taken modulo the size, so that no bit number reaches other memory.
class ReadyBits {
  public:
    static constexpr unsigned size = 64 * layout::doorbell_words;

    constexpr ReadyBits() = default;
    constexpr ReadyBits(std::initializer_list<unsigned> bits) {
        for (const unsigned bit : bits) set(bit);
    }

    constexpr void set(unsigned bit) { words[bit / 64 % words.size()] |= std::uint64_t{1} << (bit % 64); }
    constexpr bool test(unsigned bit) const {
        return (words[bit / 64 % words.size()] >> (bit % 64) & 1U) != 0;
    }
    constexpr bool any() const {
        std::uint64_t all = 0;
        for (const auto word : words) all |= word;
        return all != 0;
    }
    constexpr bool operator==(const ReadyBits&) const = default;
    constexpr ReadyBits& operator|=(const ReadyBits& other) {
        for (std::size_t i = 0; i < words.size(); ++i) words[i] |= other.words[i];
        return *this;
    }

    /// Calls use(bit) for each set bit, lowest first.
    template <class Use>
    void for_each(Use&& use) const {
        for (std::size_t i = 0; i < words.size(); ++i)
            for (std::uint64_t word = words[i]; word != 0; word &= word - 1)
                use(static_cast<unsigned>(64 * i + static_cast<unsigned>(std::countr_zero(word))));
    }

    std::array<std::uint64_t, layout::doorbell_words> words{};
};

} // namespace tandem::shm
