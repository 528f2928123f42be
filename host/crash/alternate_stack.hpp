// SPDX-License-Identifier: Apache-2.0
// Internal to host/crash.
#pragma once

namespace tandem::crash {

/// Lets this thread's signal handlers run on a stack of their own from now on, so that they can report a stack
/// overflow, too. Nothing happens before install_crash_report(), or if the thread has such a stack. [any-thread]
void give_this_thread_an_alternate_stack();

/// From now on give_this_thread_an_alternate_stack() has an effect. [main-thread]
void enable_alternate_stacks();

} // namespace tandem::crash
