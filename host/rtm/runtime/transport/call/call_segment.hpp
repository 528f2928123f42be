// SPDX-License-Identifier: Apache-2.0
// What both ends of a segment for service calls agree on: the call queue, and the form of its requests and replies.
#pragma once
#include "shm/call/call_queue.hpp"
#include "shm/segment.hpp"
#include <cstddef>
#include <memory>
#include <omniORB4/CORBA.h>
#include <span>
#include <string>
#include <string_view>

namespace RTC {

/// How the link names of such segments begin. A caller may name no other segment for its peer to open.
constexpr std::string_view call_link_prefix = "rtm-calls-";
/// The number of calls that one queue carries at a time.
constexpr std::uint32_t max_shared_calls = 16;

/// A segment with one call queue.
struct CallSegment {
    std::shared_ptr<tandem::shm::Segment> segment;
    tandem::shm::CallQueueHandle calls;
};

/// Creates the segment of that link, for its caller. Throws tandem::shm::Error, for example if /dev/shm is full.
CallSegment create_call_segment(const std::string& link);
/// Opens the segment that the caller has created. Throws tandem::shm::Error, for example if there is no such link on
/// this machine, or if the name is not one of a segment for calls.
CallSegment open_call_segment(const std::string& link);

/// A request is, in CDR of this machine's byte order: whether it is oneway (ULong), the calling thread (ULongLong), the
/// operation (raw string), the arguments. A reply is its ReplyKind (ULong) and the results, or an exception: the
/// repository id (raw string), and the fields of a user exception, or the minor code and the completion (ULong each) of a
/// system exception.
enum class ReplyKind : CORBA::ULong {
    results,
    user_exception,
    system_exception,
    not_here ///< has not run: the object is not active, or is elsewhere; a call of the ORB says more
};

/// Writes a request or a reply, or reads one that another process has written.
class CallStream : public cdrMemoryStream {
  public:
    /// Writes.
    CallStream() : cdrMemoryStream(initial_bytes) {}
    /// Reads bytes that stay valid and are aligned to 8. `completed`: for exceptions about them.
    CallStream(std::span<const std::byte> bytes, CORBA::CompletionStatus completed)
        : cdrMemoryStream(const_cast<std::byte*>(bytes.data()), bytes.size()), completed_(completed) {}

    std::span<const std::byte> written() const {
        return {static_cast<const std::byte*>(bufPtr()), bufSize()};
    }
    /// Returns whether this number of items is left. The ORB's own check overflows at 4 GiB.
    CORBA::Boolean checkInputOverrun(CORBA::ULong item_bytes, CORBA::ULong items,
                                     omni::alignment_t alignment) override;
    CORBA::ULong completion() override { return completed_; }
    void set_completion(CORBA::CompletionStatus completed) { completed_ = completed; }

  private:
    static constexpr CORBA::ULong initial_bytes = 512;
    CORBA::CompletionStatus completed_ = CORBA::COMPLETED_NO;
};

} // namespace RTC
