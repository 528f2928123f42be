// SPDX-License-Identifier: Apache-2.0
#include "host/rt/rehearsal.hpp"

namespace tandem::rt {

constinit thread_local bool this_thread_rehearses [[gnu::tls_model("initial-exec")]] = false;

} // namespace tandem::rt
