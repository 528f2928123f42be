// SPDX-License-Identifier: Apache-2.0
// Internal to the call queue: the limit of file sizes of this process (RLIMIT_FSIZE, ulimit -f).
#pragma once
#include "shm/call/call_loans.hpp"

namespace tandem::shm {

/// Returns whether a payload of this size in a slot's loan exceeds the limit. Writing it would end the process with
/// SIGXFSZ.
bool exceeds_file_limit(const CallLoans& loans, std::uint32_t slot, std::size_t bytes);

} // namespace tandem::shm
