// SPDX-License-Identifier: Apache-2.0
#include "host/rt/rehearsal.hpp"

#include "host/rt/crossings.hpp"

namespace tandem::rt {

constinit thread_local bool this_thread_rehearses [[gnu::tls_model("initial-exec")]] = false;
constinit thread_local std::uint64_t this_thread_crossings [[gnu::tls_model("initial-exec")]] = 0;

} // namespace tandem::rt
