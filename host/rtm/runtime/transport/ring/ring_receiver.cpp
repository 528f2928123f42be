// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/ring/ring_receiver.hpp"
#include "RingInPortStub.h"
#include "host/rtm/runtime/network/peer_machine.hpp"
#include "host/rtm/runtime/transport/connection_profile.hpp"
#include "host/rtm/runtime/transport/ring/message_ring.hpp"
#include "host/rtm/runtime/transport/ring/ring_in_port.hpp"
#include <rtm/SystemLogger.h>

namespace RTC {
namespace {

/// Each message goes into the ring if it can, otherwise by a call, before which the other side takes what is in the ring.
class RingReceiver : public RemoteReceiver {
  public:
    RingReceiver(std::unique_ptr<MessageRingWriter> ring, TandemRtm::RingInPort_ptr in_port,
                 std::unique_ptr<RemoteReceiver> calls)
        : ring_(std::move(ring)), in_port_(TandemRtm::RingInPort::_duplicate(in_port)),
          calls_(std::move(calls)) {}

    std::optional<DataPortStatus> put(const ByteData& bytes) override {
        if (putAtOnce(bytes)) return DataPortStatus::PORT_OK;
        const auto status = calls_->put(bytes);
        // A call without an answer may still be under way, and no later message may overtake it through the ring. Calls do not
        // overtake each other: after the next answer it is not.
        all_answered_ = status && *status != DataPortStatus::CONNECTION_LOST;
        return status;
    }
    bool putAtOnce(const ByteData& bytes) override {
        if (!all_answered_ ||
            !ring_->write(std::as_bytes(std::span(bytes.getBuffer(), bytes.getDataLength()))))
            return false;
        if (ring_->isRefused()) askToTake();
        return true;
    }
    void setTimeout(std::chrono::milliseconds timeout) override { calls_->setTimeout(timeout); }

  private:
    // A listener has come to the port while the message was written. The call has no answer, so it does not wait. An exception says
    // that the process has ended, as the next message's call will.
    void askToTake() {
        try {
            in_port_->take();
        } catch (const CORBA::SystemException&) {
        }
    }

    const std::unique_ptr<MessageRingWriter> ring_;
    const TandemRtm::RingInPort_var in_port_;
    const std::unique_ptr<RemoteReceiver> calls_;
    bool all_answered_ = true;
};

} // namespace

std::unique_ptr<RemoteReceiver> put_ring_before(std::unique_ptr<RemoteReceiver> calls,
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
        ring->removeName();
        return std::make_unique<RingReceiver>(std::move(ring), in_port.in(), std::move(calls));
    } catch (const tandem::shm::Error& error) {
        RTC_DEBUG(("messages go by calls, not through shared memory: %s", error.what()));
    } catch (const CORBA::SystemException& error) {
        RTC_DEBUG(
            ("messages go by calls, not through shared memory: the InPort's process cannot be called (%s)",
             error._name()));
    }
    return calls;
}

} // namespace RTC
