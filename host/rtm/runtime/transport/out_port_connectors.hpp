// SPDX-License-Identifier: Apache-2.0
// The two kinds of connectors of an OutPort: this side pushes, or the peer pulls.
#pragma once
#include "host/rtm/runtime/transport/cdr_servants.hpp"
#include "host/rtm/runtime/transport/newest/newest_push.hpp"
#include "host/rtm/runtime/transport/peer_answers.hpp"
#include "host/rtm/runtime/transport/publisher.hpp"
#include "host/rtm/runtime/transport/registered_transports.hpp"
#include "host/rtm/runtime/transport/remote_push.hpp"
#include <rtm/OutPortConnector.h>

namespace RTC {

class OutPortBase;

/// The connector if this side pushes, to a PushReceiver of this process or to another process by CORBA or a library's
/// transport. It pushes in the writer's thread (subscription_type flush) or in a publisher's thread (new, periodic).
class OutPortPushConnector final : public OutPortConnector {
  public:
    OutPortPushConnector(OutPortBase& port, ConnectorInfo& info, std::shared_ptr<PushReceiver> local);
    OutPortPushConnector(OutPortBase& port, ConnectorInfo& info, std::unique_ptr<RemoteReceiver> remote);
    /// For a publisher, whose messages are sent by several simultaneous calls.
    OutPortPushConnector(OutPortBase& port, ConnectorInfo& info, std::unique_ptr<NumberedReceiver> remote);
    ~OutPortPushConnector() override;

    using OutPortConnector::write;
    DataPortStatus write(ByteData& bytes) override;
    bool writeInPlace(const Marshal& marshal, DataPortStatus& status) override {
        return !m_listeners->hasDataListener() && local_receiver_->receive_in_place(marshal, status);
    }
    /// Calls writeInPlace() in a rehearsal, if the receiver has an InPlaceBuffer.
    void rehearse(const Marshal& marshal);
    bool writeDirect(const DirectValue& message, DataPortStatus& status) override;
    /// Ends the publisher's thread after the current delivery.
    DataPortStatus disconnect() override;
    /// Returns the publisher's buffer, or NULL without a publisher.
    CdrBufferBase* getBuffer() override { return publisher_ ? &publisher_->buffer() : nullptr; }
    /// Returns the number of messages that the publisher's buffer has lost; 0 without a publisher, because the writer then knows
    /// of each loss.
    std::uint64_t lost() const { return publisher_ ? publisher_->lost() : 0; }
    /// Returns the number of messages that write() has queued for another machine and that have not arrived, or not yet.
    std::uint64_t undelivered() const { return remote_push_ ? remote_push_->undelivered() : 0; }
    /// Tells the connector whether it is the only one of its port. If not, the other connectors must not wait for a
    /// receiver that hangs. [with the port's m_dataMutex held, like write()]
    void set_sole_connector(bool is_sole) { is_sole_connector_ = is_sole; }

  private:
    DataPortStatus publish(ByteData& bytes);
    DataPortStatus deliver(ByteData& bytes);
    DataPortStatus send(ByteData& bytes);

    // One of the four is set: of this process; of another process with a publisher's thread, which may wait
    // for answers; of another process without one; of another machine with one, where the newest message counts.
    std::shared_ptr<PushReceiver> local_receiver_;
    std::unique_ptr<RemoteReceiver> remote_receiver_;
    std::unique_ptr<RemotePush> remote_push_;
    std::unique_ptr<NewestPush> newest_push_;
    std::unique_ptr<Publisher> publisher_;
    bool is_sole_connector_ = true;
    PeerErrors errors_;
};

/// The connector that keeps messages until the peer pulls them. An InPort of this process takes them from the
/// PullBuffer directly, another process through the servant, and a library's transport through
/// OutPortConnector::read().
class OutPortPullConnector : public OutPortConnector {
  public:
    OutPortPullConnector(OutPortBase& port, ConnectorInfo& info);
    ~OutPortPullConnector() override;

    using OutPortConnector::write;
    DataPortStatus write(ByteData& bytes) override;
    /// Returns when no message is being fetched.
    DataPortStatus disconnect() override;
    CdrBufferBase* getBuffer() override { return &pull_buffer_->buffer(); }
    std::shared_ptr<PullBuffer> pull_buffer() const { return pull_buffer_; }
    const ServantHolder& servant() const { return servant_; }
    /// The connection uses a library's transport: its provider reads from this connector.
    void set_provider(RegisteredOutPortProvider provider) { provider_ = std::move(provider); }

  private:
    RegisteredOutPortProvider provider_{nullptr, nullptr};
    std::shared_ptr<PullBuffer> pull_buffer_;
    ServantHolder servant_;
};

} // namespace RTC
