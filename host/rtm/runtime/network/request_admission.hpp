// SPDX-License-Identifier: Apache-2.0
// Bounds the time and the memory of the requests that ORB threads receive. A thread serves one request at a time, so
// these functions keep its state in the thread. [ORB thread]
#pragma once
#include <cstddef>

namespace omni {
class GIOP_S;
}

namespace RTC {

/// Starts the next request of this thread. `shares_thread`: the connection has no thread of its own, and its data has
/// begun to arrive, so that the wait for the header is bounded too.
void begin_request(omni::GIOP_S& request, bool shares_thread);

/// Takes memory for a message of `size` bytes, and waits until other requests have released it. `is_complete`: its
/// bytes have arrived; otherwise the rest has a deadline. Returns NULL, or the reason why it is refused.
const char* admit_message(omni::GIOP_S& request, std::size_t size, bool is_complete);

/// Releases the memory, and logs a request that was not complete in time. NULL: there was no request.
void end_request(omni::GIOP_S* request);

/// Ends the deadline of a request when its reply is sent. Call it once, after ORB_init().
void set_up_request_deadlines();

} // namespace RTC
