// SPDX-License-Identifier: Apache-2.0
#include "proxy/interceptor/corba/local_call.hpp"

#include "proxy/interceptor/corba/call_stream.hpp"
#include "proxy/interceptor/corba/refused_value.hpp"
#include "proxy/interceptor/corba/transcoder.hpp"

#include <omniORB4/callDescriptor.h>
#include <omniORB4/callHandle.h>
#include <omniORB4/omniObjRef.h>

#include <objectTable.h>

#include <algorithm>

namespace tandem::interceptor {
namespace {

/// A request whose arguments and results are in memory. It corresponds to GIOP_S, which serves requests from a socket.
class LocalRequest : public omni::IOP_S {
  public:
    const char* operation_name() const override { return name_; }
    void SkipRequestBody() override {}
    void SendException(CORBA::Exception*) override {} // exceptions are thrown to call_local()
    std::span<const std::byte> results() const { return results_; }

  protected:
    LocalRequest(const char* name, wire::MessageBuffer& memory) : memory_(memory), name_(name) {}

    wire::MessageBuffer& memory_;
    omniCallDescriptor* upcall_ = nullptr; ///< from ReceiveRequest() to SendReply()
    std::span<const std::byte> results_;

  private:
    const char* const name_;
};

/// The skeleton reads and writes the CDR itself.
class PlainRequest final : public LocalRequest {
  public:
    PlainRequest(const char* name, std::span<const std::byte> arguments, wire::MessageBuffer& memory)
        : LocalRequest(name, memory) {
        stream_.read_from(arguments);
    }

    cdrStream& getStream() override { return stream_; }
    void ReceiveRequest(omniCallDescriptor& upcall) override {
        upcall_ = &upcall;
        upcall.unmarshalArguments(stream_);
    }
    void SendReply() override {
        stream_.write_to(memory_);
        convert_results([&] { upcall_->marshalReturnedValues(stream_); });
        results_ = stream_.written();
    }

  private:
    CallStream stream_;
};

/// A request with types that have a different form in the ORB's streams.
class TranscodedRequest final : public LocalRequest {
  public:
    TranscodedRequest(const char* name, const wire::Operation& operation,
                      std::span<const std::byte> arguments, wire::MessageBuffer& memory)
        : LocalRequest(name, memory), operation_(operation), arguments_(arguments) {}

    cdrStream& getStream() override { return stream_; }
    void ReceiveRequest(omniCallDescriptor& upcall) override {
        upcall_ = &upcall;
        wire::CdrReader reader(arguments_);
        from_cdr(operation_.request, reader, stream_);
        upcall.unmarshalArguments(stream_);
    }
    void SendReply() override {
        stream_.rewindPtrs();
        wire::CdrWriter writer(memory_);
        convert_results([&] {
            upcall_->marshalReturnedValues(stream_);
            to_cdr(operation_.reply, stream_, writer);
        });
        results_ = writer.written();
    }

  private:
    const wire::Operation& operation_;
    std::span<const std::byte> arguments_;
    cdrMemoryStream stream_;
};

/// The ORB's mutex of object references and objects; dispatch() below is entered with it and returns without.
class InternalLock {
  public:
    InternalLock() { omni::internalLock->lock(); }
    ~InternalLock() {
        if (held_) omni::internalLock->unlock();
    }
    InternalLock(const InternalLock&) = delete;
    InternalLock& operator=(const InternalLock&) = delete;
    void hand_over() { held_ = false; }

  private:
    bool held_ = true;
};

/// The active object of a reference, which remembers it; with the ORB's internal lock. GIOP_S and omniInProcessIdentity look
/// for objects in the same way.
omniLocalIdentity* find_object(omniObjRef& reference) {
    omniIdentity* identity = reference._identity();
    if (!identity->inThisAddressSpace() || identity->keysize() < 0) return nullptr;
    omniLocalIdentity* found = omniObjTable::locateActive(
        identity->key(), identity->keysize(), omni::hash(identity->key(), identity->keysize()), true);
    // Compiled stubs that use the same reference call a servant that it remembers directly.
    if (found && !found->deactivated() && found->servant()->_ptrToInterface(reference._localServantTarget()))
        reference._setIdentity(found);
    return found;
}

/// Returns the ORB's record of this thread. Without it, the ORB would register the thread for each call, which takes as long as
/// the call.
omni_thread* orb_thread() {
    if (omni_thread* const known = omni_thread::self()) return known;
    thread_local const omni_thread::ensure_self known_from_now_on;
    return omni_thread::self();
}

bool dispatch(omniObjRef& reference, LocalRequest& request) {
    omniCallHandle handle(&request, orb_thread());
    InternalLock lock;
    omniLocalIdentity* object = omniLocalIdentity::downcast(reference._identity());
    if (!object || object->deactivated()) [[unlikely]]
        object = find_object(reference);
    if (!object) return false;
    lock.hand_over();
    object->dispatch(handle);
    return true;
}

bool is_aligned(std::span<const std::byte> bytes) {
    return reinterpret_cast<std::uintptr_t>(bytes.data()) % sizeof(std::uint64_t) == 0;
}

} // namespace

std::optional<std::span<const std::byte>> call_local(omniObjRef& reference, const char* name,
                                                     const wire::Operation& operation,
                                                     std::span<const std::byte> arguments,
                                                     wire::MessageBuffer& memory) {
    const auto run = [&](LocalRequest& request) -> std::optional<std::span<const std::byte>> {
        if (!dispatch(reference, request)) return std::nullopt;
        return request.results();
    };
    try {
        if (operation.plain_request && operation.plain_reply && is_aligned(arguments)) [[likely]] {
            const auto expected = arguments.first(std::min(arguments.size(), operation.max_request_bytes));
            PlainRequest request(name, expected, memory);
            return run(request);
        }
        TranscodedRequest request(name, operation, arguments, memory);
        return run(request);
    } catch (const CORBA::Exception&) {
        throw;
    } catch (omniORB::LOCATION_FORWARD& forward) {
        const CORBA::Object_var released(forward.get_obj());
        return std::nullopt; // the ORB calls again, and follows it
    } catch (...) {          // the ORB converts other exceptions in the same way
        throw CORBA::UNKNOWN(0, CORBA::COMPLETED_MAYBE);
    }
}

} // namespace tandem::interceptor
