// SPDX-License-Identifier: Apache-2.0
// Internal to host/crash.
#pragma once

namespace tandem::crash {

/// Lets this thread's signal handlers run on a separate stack from now on, so that they can also report a stack
/// overflow. Does nothing before install_crash_report() or if the thread already has such a stack. [any-thread]
void give_this_thread_an_alternate_stack();

/// Lets give_this_thread_an_alternate_stack() take effect from now on. [main-thread]
void enable_alternate_stacks();

} // namespace tandem::crash
