// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shm/wait/wait_options.hpp"

namespace tandem::link {

/// Returns how calls across links wait, for the whole process: $TANDEM_WAIT_MODE, which the hosts set from
/// --wait-mode, or spin-then-futex. $TANDEM_CALL_HISTORY=1 makes calls recordable. Throws LinkError if the variable
/// names no mode.
shm::WaitOptions wait_options_from_environment();

} // namespace tandem::link
