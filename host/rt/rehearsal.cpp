// SPDX-License-Identifier: Apache-2.0
#include "host/rt/rehearsal.hpp"

#include "host/rt/crossings.hpp"
#include "host/rt/cycle_lines.hpp"

namespace tandem::rt {

constinit thread_local bool this_thread_rehearses [[gnu::tls_model("initial-exec")]] = false;
constinit thread_local std::uint64_t this_thread_crossings [[gnu::tls_model("initial-exec")]] = 0;
constinit thread_local CycleLines* this_thread_lines [[gnu::tls_model("initial-exec")]] = nullptr;

} // namespace tandem::rt
