// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <functional>

namespace RTC {

/// Runs `work`, which calls objects of other processes, in a detached thread. The thread is counted until it has destroyed
/// `work`. Returns false if the process cannot create another thread. [any-thread]
bool start_sending_thread(std::function<void()> work);
/// Waits at most `timeout` until no such thread runs. Returns false if one still runs; the ORB and static objects must then not
/// be destroyed. [any-thread]
bool sending_threads_end_within(std::chrono::nanoseconds timeout);

} // namespace RTC
