// SPDX-License-Identifier: Apache-2.0
// Internal to the call queue: the request word and the reply word of a slot. layout.hpp defines their format.
#pragma once
#include "shm/segment/layout.hpp"

namespace tandem::shm {

enum class CallStatus : std::uint32_t {
    ok,
    no_such_operation,
    bad_arguments,
    exception,
    timeout,
    peer_died,
    overload,
    shut_down,
    not_ready,      ///< nobody can execute the call yet; it has not run
    user_exception, ///< the bytes hold the exception
    cancelled       ///< by the caller, before the reply
};

constexpr std::uint64_t call_sequence_mask = (std::uint64_t{1} << 28) - 1;

/// Packs a word: 4 bits of `tag` (CallState of a request, CallStatus of a reply, else 0), 28 of `sequence`, 32 of `length`.
constexpr std::uint64_t call_word(std::uint32_t tag, std::uint64_t sequence, std::uint64_t length) {
    return (length << 32) | ((sequence & call_sequence_mask) << 4) | (tag & 15U);
}
constexpr std::uint64_t call_word(layout::CallState state, std::uint64_t sequence, std::uint64_t length) {
    return call_word(static_cast<std::uint32_t>(state), sequence, length);
}
constexpr std::uint64_t call_word(CallStatus status, std::uint64_t sequence, std::uint64_t length) {
    return call_word(static_cast<std::uint32_t>(status), sequence, length);
}

constexpr std::uint32_t tag_of(std::uint64_t word) { return static_cast<std::uint32_t>(word & 15U); }
constexpr std::uint64_t sequence_of(std::uint64_t word) { return (word >> 4) & call_sequence_mask; }
constexpr std::uint64_t length_of(std::uint64_t word) { return word >> 32; }

constexpr bool has_state(std::uint64_t word, layout::CallState state) {
    return tag_of(word) == static_cast<std::uint32_t>(state);
}
/// Returns whether a worker has claimed the call of this request word.
constexpr bool is_claimed(std::uint64_t word, std::uint64_t claim) {
    return sequence_of(word) == sequence_of(claim);
}
/// Returns the word of the same call in another state.
constexpr std::uint64_t with_state(std::uint64_t word, layout::CallState state) {
    return (word & ~std::uint64_t{15}) | static_cast<std::uint32_t>(state);
}

/// The word with the progress of a call: `share` from 0 to 1, in units of 1e-9. NaN becomes 0.
constexpr double progress_unit = 1e-9;
constexpr std::uint64_t progress_word(std::uint64_t sequence, double share) {
    const double bounded = share > 0 ? (share < 1 ? share : 1) : 0;
    const double rounded = bounded / progress_unit + 0.5; // std::lround() is not constexpr
    return call_word(0U, sequence, static_cast<std::uint64_t>(rounded));
}
/// Returns a share from 0 to 1, whatever the word is.
constexpr double share_of(std::uint64_t progress) {
    const double share = static_cast<double>(length_of(progress)) * progress_unit;
    return share < 1 ? share : 1;
}

/// Returns whether the duration of this call is measured. Only some calls are, because reading the clock takes a tenth of a
/// short call.
constexpr bool is_timed(std::uint64_t word) {
    return sequence_of(word) <= 1024 || sequence_of(word) % 16 == 0;
}

} // namespace tandem::shm
