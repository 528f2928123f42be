// SPDX-License-Identifier: Apache-2.0
// Bounds the time and the memory of the requests that ORB threads receive. A thread serves one request at a time, so
// these functions keep its state in the thread. [ORB thread]
#pragma once
#include <cstddef>

namespace omni {
class GIOP_S;
}

namespace RTC {

/// The header of a message that has begun to arrive.
struct ArrivingMessage {
    unsigned char type; ///< of GIOP
    std::size_t size;
    bool is_complete; ///< it has arrived, and no fragment follows
};

/// Starts the next request of this thread. `shares_thread`: the connection has no separate thread, and its data has
/// begun to arrive, so that the wait for the header is bounded too.
void begin_request(omni::GIOP_S& request, bool shares_thread);

/// Takes memory for a message, and waits until other requests have released it. The rest of an incomplete request has a
/// deadline. Returns NULL, or the reason why the message is refused.
const char* admit_message(omni::GIOP_S& request, const ArrivingMessage& message);

/// Releases the memory, notes that the connection was in use, and logs a client that was too slow. NULL: there was no
/// request.
void end_request(omni::GIOP_S* request);

/// Ends the deadline of a request, and releases its memory, when it has arrived. Call it after ORB_init().
void set_up_request_deadlines();

} // namespace RTC
