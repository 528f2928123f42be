// SPDX-License-Identifier: Apache-2.0
#include "NumberedInPortStub.h"
#include "host/rtm/runtime/transport/cdr_servants.hpp"
#include "host/rtm/runtime/transport/connection_profile.hpp"
#include "host/rtm/runtime/transport/newest/newest_push.hpp"
#include "host/rtm/runtime/transport/newest/numbered_in_port.hpp"
#include "host/rtm/runtime/transport/peer_answers.hpp"
#include "host/rtm/runtime/transport/remote_endpoints.hpp"

namespace RTC {
namespace {

class CorbaNumberedReceiver : public NumberedReceiver {
  public:
    CorbaNumberedReceiver(CORBA::Object_ptr object, std::chrono::milliseconds answer_timeout)
        : object_(TandemRtm::NumberedInPort::_unchecked_narrow(object)), answers_(object) {
        set_call_timeout(object_.in(), answer_timeout);
    }
    bool is_on_another_machine() const { return answers_.is_on_another_machine(); }
    std::optional<DataPortStatus> put(std::uint64_t number, const ByteData& bytes) override {
        const auto length = static_cast<CORBA::ULong>(bytes.getDataLength());
        const auto begun = answers_.now();
        try {
            // A sequence that refers to the existing bytes: `false` leaves them to their owner.
            const auto status = from_port_status(
                object_->put(number, OpenRTM::CdrData(length, length, bytes.getBuffer(), false)));
            answers_.answered();
            return status;
        } catch (const CORBA::SystemException& e) {
            return answers_.failed(e, begun);
        }
    }

  private:
    TandemRtm::NumberedInPort_var object_;
    PeerAnswers answers_;
};

} // namespace

std::unique_ptr<NumberedReceiver> NumberedReceiver::find(const ConnectorProfile& profile,
                                                         std::chrono::milliseconds answer_timeout) {
    const CORBA::Object_var object = find_published_object(profile, numbered_in_port_key);
    if (CORBA::is_nil(object.in())) return nullptr;
    auto receiver = std::make_unique<CorbaNumberedReceiver>(object.in(), answer_timeout);
    return receiver->is_on_another_machine() ? std::move(receiver) : nullptr;
}

} // namespace RTC
