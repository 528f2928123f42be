// SPDX-License-Identifier: Apache-2.0
// The limits of service calls across a link. docs/joining.md describes them for users.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace tandem::link {

/// Calls of one direction that may be under way at once, including those that wait for nested calls. Further callers wait for
/// one of them to end, in the order in which they came, up to their deadline. A chain of nested calls that enters a direction
/// n times counts n times.
constexpr std::uint32_t max_calls = 128;
/// Threads that execute the peer's calls. Fewer than max_calls would let nested calls block each other.
constexpr std::size_t max_workers = max_calls;
/// The stack of such a thread, all of which --lock-memory locks. 1 MiB is the default of Windows, so components that also run
/// there manage with it.
constexpr std::size_t worker_stack_bytes = std::size_t{1} << 20;
/// Of more than two threads, one ends if no call has needed it for this time.
constexpr std::chrono::nanoseconds worker_idle_time = std::chrono::seconds(60);
/// Encoded arguments of a call, and its encoded results.
constexpr std::size_t max_call_bytes = std::size_t{64} << 20;
/// Calls without a reply (oneway, non-blocking) that wait to be made. Further callers wait like those above.
constexpr std::size_t max_waiting_sends = 256;
/// Total size of the arguments of these calls. A longer call may wait if no other does.
constexpr std::size_t max_waiting_send_bytes = max_call_bytes;

} // namespace tandem::link
