// SPDX-License-Identifier: Apache-2.0
// Replaces five functions of omniORB 4.2 and 4.3, which calls them through the dynamic symbol table. That finds the
// definitions in this library first.
//
// GIOP_S_Holder is the request that a thread serves. If an exception that is not a CORBA exception ends a request before its
// arguments are read, omniORB reports success and keeps the message: the thread serves it again, without end, even after
// the peer has gone. Such exceptions are its own failed assertions (the object key "\0", an address of kind 1 or 2 in
// GIOP 1.2) and the end of a fragmented request by a CancelRequest.
//
// giopStream::ensureSaneHeader() reads the header of a message. A size of 2^32 - 12 wraps to 0, and omniORB then splits
// the message into empty ones until the memory is used up. A fragment larger than its buffer, whose size is not a
// multiple of 8, makes the copy of a long sequence continue without end.
//
// giopStrand::safeDelete() releases the socket of a connection. When the ORB ends, omniORB gives each connection that has no
// dedicated thread another worker, even if one still waits for a thread. If both workers find that the connection is refused,
// both release the socket, and the second uses freed memory.
//
// StrandList::insert() is the first function that is called for each accepted connection. Interceptors are only called
// once the connection has a thread, which a silent one may not get.
//
// The faults were found in omniORB 4.2.5. These functions are the same in 4.3.3, apart from the size of 2^32 - 12. The build
// leaves this file out for another minor version.
#include "host/rtm/runtime/network/connection_limits.hpp"
#include "host/rtm/runtime/network/request_admission.hpp"

#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <omniORB4/CORBA.h>
#include <omniORB4/internal/giopServer.h>
#include <omniORB4/internal/giopStrand.h>
#include <omniORB4/internal/giopStream.h>
#include <omniORB4/internal/invoker.h>
#include <string>

#include <omniORB4/internal/GIOP_S.h> // these need the others before them
#include <omniORB4/internal/giopWorker.h>

namespace RTC {

// Access to private members: an explicit instantiation may name them.
using BufferMember = omni::giopStream_Buffer* omni::giopStream::*;
struct CurrentInput {
    friend BufferMember member_of(CurrentInput);
};
struct QueuedInput {
    friend BufferMember member_of(QueuedInput);
};
template <class Name, BufferMember member>
struct Opened {
    friend BufferMember member_of(Name) { return member; }
};

} // namespace RTC

// The exception by which omniORB refuses a connection is private too.
namespace RTC {
struct OutOfResource {
    friend void throw_exception(OutOfResource);
};
template <class Name, class Exception>
struct OpenedException {
    friend void throw_exception(Name) { throw Exception{}; }
};
} // namespace RTC

template struct RTC::OpenedException<RTC::OutOfResource, omni::giopServer::outOfResource>;
template struct RTC::Opened<RTC::CurrentInput, &omni::giopStream::pd_currentInputBuffer>;
template struct RTC::Opened<RTC::QueuedInput, &omni::giopStream::pd_input>;

namespace {

bool has_unread_input(omni::giopStream& stream) {
    return stream.*member_of(RTC::CurrentInput{}) != nullptr ||
           stream.*member_of(RTC::QueuedInput{}) != nullptr;
}

void close_connection(omni::giopStrand& strand) {
    strand.state(omni::giopStrand::DYING);
    strand.connection->Shutdown();
    strand.connection->setSelectable(
        1); // for a thread that notices it, where the connection has no dedicated thread
}

// Closes a connection that nothing else knows yet. It takes no thread, which may be long in coming.
[[noreturn]] void refuse_connection(omni::giopStrand& strand) {
    strand.deleteStrandAndConnection();
    throw_exception(RTC::OutOfResource{});
    __builtin_unreachable();
}

/// The header of a GIOP message. [CORBA 3.0, 15.4.1]
class MessageHeader {
  public:
    explicit MessageHeader(const char* bytes) { std::memcpy(bytes_, bytes, sizeof bytes_); }
    bool has_magic() const {
        const bool may_be_compressed = omni::giopStream::compressorFactory != nullptr;
        return std::memcmp(bytes_, "GIOP", 4) == 0 ||
               (may_be_compressed && std::memcmp(bytes_, "ZIOP", 4) == 0);
    }
    unsigned char type() const { return bytes_[7]; }
    bool has_more_fragments() const { return bytes_[5] != 0 && (bytes_[6] & 2) != 0; }
    std::uint64_t size() const {
        std::uint32_t body = 0;
        std::memcpy(&body, bytes_ + 8, sizeof body);
        const bool is_little = (bytes_[6] & 1) != 0;
        if (is_little != (std::endian::native == std::endian::little)) body = __builtin_bswap32(body);
        return std::uint64_t{body} + sizeof bytes_;
    }
    const char* fault() const {
        if (!has_magic()) return "it sent something other than GIOP";
        if (size() > std::numeric_limits<CORBA::ULong>::max()) return "it announced a message of 4 GB";
        if (has_more_fragments() && size() % 8 != 0 && size() > omni::giopStream::bufferSize)
            return "it sent a fragment whose size is not a multiple of 8";
        return nullptr;
    }

  private:
    unsigned char bytes_[12];
};

} // namespace

namespace omni {

GIOP_S_Holder::GIOP_S_Holder(giopStrand* strand, giopWorker* worker)
    : pd_strand(strand), pd_iop_s(strand->acquireServer(worker)) {
    if (pd_iop_s != nullptr) RTC::begin_request(*pd_iop_s, worker->singleshot());
}

GIOP_S_Holder::~GIOP_S_Holder() {
    RTC::end_request(pd_iop_s);
    if (pd_iop_s == nullptr) return;
    if (pd_strand->state() != giopStrand::DYING && has_unread_input(*pd_iop_s)) {
        RTC::log_closed_connection(*pd_strand, "omniORB cannot read its request");
        close_connection(*pd_strand);
    }
    pd_strand->releaseServer(pd_iop_s);
}

CORBA::ULong giopStream::ensureSaneHeader(const char* file, CORBA::ULong line, giopStream_Buffer* buffer,
                                          CORBA::ULong begin) {
    const MessageHeader header(reinterpret_cast<const char*>(buffer) + begin);
    const char* fault = header.fault();
    GIOP_S* const request = GIOP_S::downcast(this);
    if (fault == nullptr && request != nullptr && begin == buffer->start) // otherwise it is read later
        fault = RTC::admit_message(*request,
                                   {header.type(), header.size(),
                                    header.size() <= buffer->last - begin && !header.has_more_fragments()});
    if (fault == nullptr) return static_cast<CORBA::ULong>(header.size());
    if (request != nullptr) RTC::log_closed_connection(*pd_strand, fault);
    pd_strand->state(giopStrand::DYING);
    CORBA::ULong minor = 0;
    CORBA::Boolean retry = false;
    notifyCommFailure(false, minor, retry);
    giopStream_Buffer::deleteBuffer(buffer);
    CommFailure::_raise(minor, static_cast<CORBA::CompletionStatus>(completion()), retry, file, line, fault,
                        pd_strand);
    return 0;
}

CORBA::Boolean giopStrand::safeDelete(CORBA::Boolean forced) {
    if (forced) {
        deleteStrandAndConnection(true);
        return true;
    }
    pd_safelyDeleted = true;
    const bool is_unused = giopStreamList::is_empty(clients) && giopStreamList::is_empty(servers) &&
                           giopStream::noLockWaiting(this);
    if (is_unused && (isClient() || RTC::note_release(*this))) {
        StrandList::remove();
        RopeLink::remove();
        deleteStrandAndConnection();
    }
    return true;
}

void StrandList::insert(StrandList& head) {
    if (&head == &giopStrand::passive)
        if (auto& strand = static_cast<giopStrand&>(*this); !RTC::admit_connection(strand))
            refuse_connection(strand);
    next = &head;
    prev = head.prev;
    prev->next = this;
    head.prev = this;
}

} // namespace omni
