// SPDX-License-Identifier: Apache-2.0
#include "host/rtm/runtime/transport/ring/ring_in_port.hpp"
#include "RingInPortSkel.h"
#include "host/rtm/runtime/transport/remote_endpoints.hpp"
#include "host/rtm/runtime/transport/ring/message_ring.hpp"
#include <rtm/SystemLogger.h>
#include <rtm/Timestamp.h>

namespace RTC {
namespace {

/// [ORB threads]
class RingInPortServant : public POA_TandemRtm::RingInPort {
  public:
    RingInPortServant(std::shared_ptr<PushReceiver> receiver, bool little_endian)
        : receiver_(std::move(receiver)), little_endian_(little_endian) {}
    CORBA::Boolean open(const char* link) override {
        try {
            return receiver_->open_ring(std::make_unique<MessageRingReader>(link), little_endian_);
        } catch (const tandem::shm::Error& error) {
            const Logger rtclog("connections");
            RTC_DEBUG(("messages come by calls, not through shared memory: %s", error.what()));
            return false;
        }
    }
    void take() override { receiver_->receive_from_ring(); }

  private:
    std::shared_ptr<PushReceiver> receiver_;
    bool little_endian_;
};

} // namespace

bool can_receive_from_ring(const coil::Properties& properties) {
    const auto is_default = [&](const char* key, const char* value) {
        const std::string policy = coil::normalize(properties.getProperty(key));
        return policy.empty() || policy == value;
    };
    return is_default("buffer_type", "ring_buffer") && is_default("buffer.write.full_policy", "overwrite") &&
           coil::normalize(properties.getProperty("buffer.read.empty_policy")) != "block" &&
           timestampPolicy(properties) != TimestampPolicy::on_received;
}

PortableServer::ServantBase* create_ring_servant(std::shared_ptr<PushReceiver> receiver, bool little_endian) {
    return new RingInPortServant(std::move(receiver), little_endian);
}

} // namespace RTC
