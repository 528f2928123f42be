// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/newest/numbered_in_port.hpp"
#include "NumberedInPortSkel.h"
#include "host/rtm/runtime/transport/cdr_servants.hpp"

namespace RTC {
namespace {

/// [ORB threads, one for each connection of the sender]
class NumberedInPortServant : public POA_TandemRtm::NumberedInPort {
  public:
    NumberedInPortServant(std::shared_ptr<PushReceiver> receiver, bool little_endian)
        : receiver_(std::move(receiver)), little_endian_(little_endian) {}
    OpenRTM::PortStatus put(CORBA::ULongLong number, const OpenRTM::CdrData& data) override {
        ByteData bytes = received_message(data, little_endian_);
        return to_port_status(receiver_->receive_numbered(number, bytes));
    }

  private:
    std::shared_ptr<PushReceiver> receiver_;
    bool little_endian_;
};

} // namespace

PortableServer::ServantBase* create_numbered_servant(std::shared_ptr<PushReceiver> receiver,
                                                     bool little_endian) {
    return new NumberedInPortServant(std::move(receiver), little_endian);
}

} // namespace RTC
