// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace tandem::rt {

/// Sum of note_crossings(), like `this_thread_rehearses` (rehearsal.hpp).
extern constinit thread_local std::uint64_t this_thread_crossings [[gnu::tls_model("initial-exec")]];

/// Reports, in a rehearsal, the number of messages that have crossed so far at the place that the rehearsal has reached.
/// A tick whose rehearsals report no new messages does not poll by default (TickPolling).
inline void note_crossings(std::uint64_t messages) noexcept { this_thread_crossings += messages; }

} // namespace tandem::rt
