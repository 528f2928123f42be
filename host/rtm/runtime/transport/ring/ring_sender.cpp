// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/ring/ring_sender.hpp"
#include "RingInPortStub.h"
#include "host/rtm/runtime/network/peer_machine.hpp"
#include "host/rtm/runtime/transport/cdr_servants.hpp"
#include "host/rtm/runtime/transport/connection_profile.hpp"
#include "host/rtm/runtime/transport/ring/message_ring.hpp"
#include "host/rtm/runtime/transport/ring/ring_in_port.hpp"
#include <rtm/SystemLogger.h>

namespace RTC {
namespace {

/// The sender's side of a connection with a ring. Puts each message into the ring if possible. If the port has
/// listeners, then calls the other side through shared memory to receive the message. Sends other messages by a call of
/// the ORB; the other side first receives the messages in the ring.
class RingSender : public RemoteReceiver {
  public:
    RingSender(std::unique_ptr<MessageRingWriter> ring, TandemRtm::RingInPort_ptr in_port,
               std::unique_ptr<RemoteReceiver> calls)
        : ring_(std::move(ring)), in_port_(TandemRtm::RingInPort::_duplicate(in_port)),
          calls_(std::move(calls)) {}

    std::optional<DataPortStatus> put(const ByteData& bytes) override {
        if (try_put(bytes)) return DataPortStatus::PORT_OK;
        if (all_answered_ && ring_->write_for_server(as_span(bytes))) {
            const auto answer = ring_->call_server(timeout_);
            if (!is_closed(answer.status)) return status_of(answer); // otherwise the ORB says why
        }
        const auto status = calls_->put(bytes);
        // A call without an answer may still be in progress, and no later message may overtake it through the ring.
        // Calls do not overtake each other, so after the next answer that call has ended.
        all_answered_ = status && *status != DataPortStatus::CONNECTION_LOST;
        return status;
    }
    bool try_put(const ByteData& bytes) override {
        if (!all_answered_ || !ring_->write(as_span(bytes))) return false;
        if (ring_->is_refused()) ask_to_take();
        return true;
    }
    void set_timeout(std::chrono::milliseconds timeout) override {
        timeout_ = timeout;
        calls_->set_timeout(timeout);
    }

  private:
    static std::span<const std::byte> as_span(const ByteData& bytes) {
        return std::as_bytes(std::span(bytes.getBuffer(), bytes.getDataLength()));
    }
    static bool is_closed(tandem::shm::CallStatus status) {
        return status == tandem::shm::CallStatus::peer_died || status == tandem::shm::CallStatus::shut_down;
    }
    // Returns the same as RemoteReceiver::put(). Without an answer the message stays in the ring, before later ones.
    static std::optional<DataPortStatus> status_of(const tandem::shm::ReplyView& answer) {
        using tandem::shm::CallStatus;
        if (answer.status == CallStatus::timeout || answer.status == CallStatus::overload)
            return std::nullopt;
        if (answer.status != CallStatus::ok || answer.bytes.size() != 1) return DataPortStatus::PORT_ERROR;
        return from_port_status(static_cast<OpenRTM::PortStatus>(answer.bytes.front()));
    }
    // A listener was added to the port while the message was being written. The call has no answer, so it does not
    // wait. An exception means that the process has ended; the next message's call will show that, too.
    void ask_to_take() {
        try {
            in_port_->take();
        } catch (const CORBA::SystemException&) {
        }
    }

    const std::unique_ptr<MessageRingWriter> ring_;
    const TandemRtm::RingInPort_var in_port_;
    const std::unique_ptr<RemoteReceiver> calls_;
    std::chrono::milliseconds timeout_{2000};
    bool all_answered_ = true; // the calls of the ORB
};

} // namespace

std::unique_ptr<RemoteReceiver> add_ring_if_possible(std::unique_ptr<RemoteReceiver> calls,
                                                     const ConnectorProfile& profile,
                                                     std::chrono::milliseconds answer_timeout) {
    const CORBA::Object_var object = find_published_object(profile, ring_in_port_key);
    if (CORBA::is_nil(object.in()) || !address_on_another_machine(object.in()).empty()) return calls;
    const Logger rtclog("connections");
    try {
        auto ring = std::make_unique<MessageRingWriter>();
        const TandemRtm::RingInPort_var in_port = TandemRtm::RingInPort::_unchecked_narrow(object.in());
        set_call_timeout(in_port.in(), answer_timeout);
        if (!in_port->open(ring->link().c_str())) return calls;
        ring->remove_name();
        return std::make_unique<RingSender>(std::move(ring), in_port.in(), std::move(calls));
    } catch (const tandem::shm::Error& error) {
        RTC_DEBUG(("messages are sent by calls, not through shared memory: %s", error.what()));
    } catch (const CORBA::SystemException& error) {
        RTC_DEBUG(("messages are sent by calls, not through shared memory: the InPort's process cannot be "
                   "called (%s)",
                   error._name()));
    }
    return calls;
}

} // namespace RTC
