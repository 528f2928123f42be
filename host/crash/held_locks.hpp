// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::crash {

/// Closes each descriptor of this process that holds a lock of its open file (F_OFD_SETLK). Other processes take such a
/// lock for the life of this process, and a core dump would hold it until it is written. Async-signal-safe. [one thread]
void give_up_locks();

} // namespace tandem::crash
