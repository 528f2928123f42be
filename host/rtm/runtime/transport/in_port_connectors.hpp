// SPDX-License-Identifier: Apache-2.0
// The two kinds of receiving ends.
#pragma once
#include "host/rtm/runtime/transport/cdr_servants.hpp"
#include "host/rtm/runtime/transport/registered_transports.hpp"
#include <chrono>
#include <optional>
#include <rtm/InPortConnector.h>

namespace RTC {

/// The other end pushes into an inlet.
class InPortPushConnector : public InPortConnector {
  public:
    /// `owns_buffer`: the buffer came from CdrBufferFactory for this connector alone.
    /// `direct_buffer` of a direct connection, else NULL.
    InPortPushConnector(InPortBase& port, ConnectorInfo& info, CdrBufferBase* buffer, bool owns_buffer,
                        std::shared_ptr<DirectBufferBase> direct_buffer = nullptr);
    ~InPortPushConnector() override;
    DataPortStatus disconnect() override;
    BufferStatus write(ByteData& bytes) override;
    std::shared_ptr<PushReceiver> receiver() const { return receiver_; }
    const ServantHolder& servant() const { return servant_; }
    /// A library's end writes into this connector, and tells the listeners itself.
    void setProvider(RegisteredInPortProvider provider) { provider_ = std::move(provider); }

  private:
    RegisteredInPortProvider provider_{nullptr, nullptr};
    bool owns_buffer_;
    std::shared_ptr<PushReceiver> receiver_;
    ServantHolder servant_;
};

/// This end fetches: from an outlet of this process or by CORBA.
class InPortPullConnector : public InPortConnector {
  public:
    InPortPullConnector(InPortBase& port, ConnectorInfo& info, std::shared_ptr<PullBuffer> local);
    InPortPullConnector(InPortBase& port, ConnectorInfo& info, std::unique_ptr<RemoteSender> remote);
    using InPortConnector::read;
    DataPortStatus read(ByteData& bytes) override;
    DataPortStatus disconnect() override { return DataPortStatus::PORT_OK; }
    /// Asks a sender in another process for a message, which the next read() returns; true: there is one.
    /// That there is none is what the next read() says only if `final`.
    bool prefetch(bool final);

  private:
    DataPortStatus fetch(ByteData& bytes);
    std::optional<DataPortStatus> requestMessage(ByteData& bytes);

    std::shared_ptr<PullBuffer> local_;
    std::unique_ptr<RemoteSender> remote_;
    std::chrono::milliseconds answer_timeout_{0}; // for an answer
    std::chrono::milliseconds probe_timeout_{
        0}; // after one that did not come: how long is waited for a sign of life
    std::chrono::steady_clock::time_point next_request_time_{}; // the sender is left alone until then
    std::optional<DataPortStatus> prefetched_status_;           // what came of prefetch()
    ByteData prefetched_bytes_;
    CdrRingBuffer unused_buffer_;
};

} // namespace RTC
