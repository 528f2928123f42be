// SPDX-License-Identifier: Apache-2.0
// The kinds of sending ends.
#pragma once
#include "host/rtm/runtime/transport/cdr_servants.hpp"
#include "host/rtm/runtime/transport/publisher.hpp"
#include "host/rtm/runtime/transport/registered_transports.hpp"
#include "host/rtm/runtime/transport/remote_push.hpp"
#include <rtm/OutPortConnector.h>

namespace RTC {
class OutPortBase;

/// Pushes to an receiver of this process, or by CORBA to another; at once or through a publisher thread,
/// as the property subscription_type says (flush, new, periodic).
class OutPortPushConnector : public OutPortConnector {
  public:
    OutPortPushConnector(OutPortBase& port, ConnectorInfo& info, std::shared_ptr<PushReceiver> local);
    OutPortPushConnector(OutPortBase& port, ConnectorInfo& info, std::unique_ptr<RemoteReceiver> remote);
    ~OutPortPushConnector() override;
    using OutPortConnector::write;
    DataPortStatus write(ByteData& bytes) override;
    bool writeInPlace(const Marshal& marshal, DataPortStatus& status) override;
    bool writeDirect(const DirectWriter& writer, DataPortStatus& status) override;
    DataPortStatus disconnect() override;
    CdrBufferBase* getBuffer() override { return publisher_ ? &publisher_->buffer() : nullptr; }

    /// Is it the only connector of its port? Others must not wait for a receiver that hangs.
    void setSoleConnector(bool is_sole) { is_sole_connector_ = is_sole; }

  private:
    DataPortStatus publish(ByteData& bytes);
    DataPortStatus deliver(ByteData& bytes);

    std::shared_ptr<PushReceiver> local_receiver_;
    std::unique_ptr<RemoteReceiver> remote_receiver_; // a publisher's thread sends: it may wait
    std::unique_ptr<RemotePush> remote_push_;         // the writer sends
    std::unique_ptr<Publisher> publisher_;
    bool is_sole_connector_ = true;
};

/// Keeps messages until the other end fetches them.
class OutPortPullConnector : public OutPortConnector {
  public:
    OutPortPullConnector(OutPortBase& port, ConnectorInfo& info);
    ~OutPortPullConnector() override;
    using OutPortConnector::write;
    DataPortStatus write(ByteData& bytes) override;
    DataPortStatus disconnect() override;
    CdrBufferBase* getBuffer() override { return &pull_buffer_->buffer(); }
    std::shared_ptr<PullBuffer> pullBuffer() const { return pull_buffer_; }
    const ServantHolder& servant() const { return servant_; }
    /// A library's end reads what waits here.
    void setProvider(RegisteredOutPortProvider provider) { provider_ = std::move(provider); }

  private:
    RegisteredOutPortProvider provider_{nullptr, nullptr};
    std::shared_ptr<PullBuffer> pull_buffer_;
    ServantHolder servant_;
};

} // namespace RTC
