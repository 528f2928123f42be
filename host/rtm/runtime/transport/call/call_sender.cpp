// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/call/call_sender.hpp"
#include "shm/os/clock.hpp"
#include <algorithm>
#include <coil/UUID.h>
#include <cstring>
#include <omniORB4/callDescriptor.h>
#include <omniORB4/minorCode.h>
#include <orbParameters.h>
#include <unistd.h>

namespace RTC {
namespace {

namespace shm = tandem::shm;

/// Returns the time that is left; nothing if there is none.
std::optional<std::chrono::nanoseconds> time_left(const omni_time_t& deadline) {
    if (deadline.s == 0 && deadline.ns == 0) return shm::longest_wait;
    omni_time_t now;
    omni_thread::get_time(now);
    if (deadline <= now) return std::nullopt;
    return std::chrono::seconds(deadline.s) - std::chrono::seconds(now.s) +
           std::chrono::nanoseconds(deadline.ns) - std::chrono::nanoseconds(now.ns);
}

[[noreturn]] void throw_timeout() {
    if (omni::orbParameters::throwTransientOnTimeOut)
        throw CORBA::TRANSIENT(omni::TRANSIENT_CallTimedout, CORBA::COMPLETED_MAYBE);
    throw CORBA::TIMEOUT(omni::TIMEOUT_CallTimedOutOnClient, CORBA::COMPLETED_MAYBE);
}

[[noreturn]] void throw_system_exception(CallStream& reply) {
    const CORBA::String_var id(reply.unmarshalRawString());
    CORBA::ULong minor = 0, completed = 0;
    minor <<= reply;
    completed <<= reply;
    const auto status =
        static_cast<CORBA::CompletionStatus>(std::min<CORBA::ULong>(completed, CORBA::COMPLETED_MAYBE));
#define TANDEM_THROW_IF_NAMED(name)                                                                          \
    if (std::strcmp(id.in(), "IDL:omg.org/CORBA/" #name ":1.0") == 0) throw CORBA::name(minor, status);
    OMNIORB_FOR_EACH_SYS_EXCEPTION(TANDEM_THROW_IF_NAMED)
#undef TANDEM_THROW_IF_NAMED
    throw CORBA::UNKNOWN(omni::UNKNOWN_SystemException, status);
}

/// Counts a call as running.
class Running {
  public:
    explicit Running(std::atomic<std::uint32_t>& count) : count_(count), before_(count_.fetch_add(1)) {}
    ~Running() { count_.fetch_sub(1); }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;
    std::uint32_t before() const { return before_; }

  private:
    std::atomic<std::uint32_t>& count_;
    const std::uint32_t before_;
};

} // namespace

CallSender::CallSender()
    // No other link has that name. Otherwise a segment of another container with the same /dev/shm could be joined.
    : link_(std::string(call_link_prefix) + coil::UUID_Generator().generateUUID()->to_string()),
      segment_(create_call_segment(link_)),
      // The component waits in its cycle, so it sleeps, as in a call of the ORB.
      calls_(segment_.calls, {.mode = shm::WaitMode::futex}) {}

void CallSender::remove_name() { ::unlink(segment_.segment->path().c_str()); }

// Checks only every 10 ms, because a check takes a system call. So a process that has ended is detected before the call
// begins, unless it ends at this moment.
bool CallSender::is_served() {
    constexpr std::uint64_t pause_ns = 10'000'000;
    if (is_over_.load(std::memory_order_relaxed)) return false;
    const std::uint64_t now_ns = shm::now_ns();
    if (now_ns - checked_at_ns_.load(std::memory_order_relaxed) < pause_ns) return true;
    checked_at_ns_.store(now_ns, std::memory_order_relaxed);
    if (segment_.segment->peer_state_by_lock() != shm::PeerState::alive) is_over_ = true;
    return !is_over_;
}

// A call that has timed out keeps its slot until it ends, perhaps forever. Otherwise running calls have the slots.
bool CallSender::is_full(std::uint32_t running_before) {
    return running_before >= max_shared_calls ||
           (has_timed_out_.load(std::memory_order_relaxed) && calls_.counters().in_use >= max_shared_calls);
}

bool CallSender::call(omniCallDescriptor& call) {
    const Running running(running_);
    if (is_full(running.before()) || !is_served()) return false;
    static thread_local char this_thread;
    CallStream request;
    static_cast<CORBA::ULong>(call.is_oneway()) >>= request;
    static_cast<CORBA::ULongLong>(reinterpret_cast<std::uintptr_t>(&this_thread)) >>= request;
    request.marshalRawString(call.op());
    call.initialiseCall(request);
    call.marshalArguments(request);
    request.clearValueTracker();
    const auto timeout = time_left(call.getDeadline());
    if (!timeout || request.bufSize() > segment_.calls.view.max_bytes) return false;

    std::vector<std::byte> reply;
    switch (calls_.call_into(request.written(), *timeout, reply)) {
    case shm::CallStatus::ok:
        return read_reply(call, reply);
    case shm::CallStatus::overload: // no slot, or no memory for long arguments
        return false;
    case shm::CallStatus::shut_down:
        is_over_ = true;
        return false;
    case shm::CallStatus::timeout:
        has_timed_out_ = true;
        throw_timeout();
    case shm::CallStatus::peer_died:
        is_over_ = true;
        throw CORBA::COMM_FAILURE(omni::COMM_FAILURE_WaitingForReply, CORBA::COMPLETED_MAYBE);
    default: // there is no memory for the results, or the other process has damaged the segment
        throw CORBA::NO_RESOURCES(0, CORBA::COMPLETED_MAYBE);
    }
}

/// Returns false if the call has not been executed.
bool CallSender::read_reply(omniCallDescriptor& call, std::span<const std::byte> bytes) {
    if (call.is_oneway()) return true;
    CallStream reply(bytes, CORBA::COMPLETED_YES);
    CORBA::ULong kind = 0;
    kind <<= reply;
    switch (static_cast<ReplyKind>(kind)) {
    case ReplyKind::results:
        call.unmarshalReturnedValues(reply);
        reply.clearValueTracker();
        return true;
    case ReplyKind::user_exception: {
        const CORBA::String_var id(reply.unmarshalRawString());
        call.userException(reply, nullptr, id.in()); // throws, except in the dynamic invocation interface
        return true;
    }
    case ReplyKind::system_exception:
        throw_system_exception(reply);
    default:
        return false;
    }
}

} // namespace RTC
