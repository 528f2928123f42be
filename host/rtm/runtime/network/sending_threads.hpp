// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <functional>

namespace RTC {

/// Runs `work`, which calls objects of other processes, in a detached thread that is counted until it has let go of `work`.
/// False: the process gets no further thread. [any-thread]
bool start_sending_thread(std::function<void()> work);
/// Waits until no such thread runs. False: one still does after `timeout`; the ORB and static objects must not be destroyed then.
/// [any-thread]
bool sending_threads_end_within(std::chrono::nanoseconds timeout);

} // namespace RTC
