// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shm/wait/wait_options.hpp"

namespace tandem::link {

/// How calls across links wait, for the whole process: $TANDEM_WAIT_MODE, which our hosts set by --wait-mode;
/// spin-then-futex if there is none; and, with $TANDEM_CALL_HISTORY=1, so that calls can be recorded. Throws LinkError when it names no mode.
shm::WaitOptions wait_options_from_environment();

} // namespace tandem::link
