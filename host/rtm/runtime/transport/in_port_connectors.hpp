// SPDX-License-Identifier: Apache-2.0
// The two kinds of connectors of an InPort: the peer pushes, or this side pulls.
#pragma once
#include "host/rtm/runtime/transport/buffer/port_buffer.hpp"
#include "host/rtm/runtime/transport/cdr_servants.hpp"
#include "host/rtm/runtime/transport/peer_answers.hpp"
#include "host/rtm/runtime/transport/registered_transports.hpp"
#include <chrono>
#include <optional>
#include <rtm/InPortConnector.h>

namespace RTC {

/// The connector if the peer pushes, into the PushReceiver of this connector. An OutPort of this process calls the
/// receiver directly, another process through the servant, and a library's transport through the connector itself.
class InPortPushConnector : public InPortConnector {
  public:
    /// `owns_buffer`: CdrBufferFactory made the buffer for this connector alone, and takes it back.
    /// `direct_buffer`: the port's buffer for a direct connection, else NULL.
    InPortPushConnector(InPortBase& port, ConnectorInfo& info, CdrBufferBase* buffer, bool owns_buffer,
                        std::shared_ptr<DirectBufferBase> direct_buffer = nullptr);
    ~InPortPushConnector() override;

    /// Returns when no message is being received. [any thread except in a listener of this connection]
    DataPortStatus disconnect() override;
    using InPortConnector::read;
    DataPortStatus read(ByteData& bytes) override;
    /// A library's InPortProvider calls this with a message. [transport's thread]
    BufferStatus write(ByteData& bytes) override;
    std::shared_ptr<PushReceiver> receiver() const { return receiver_; }
    const ServantHolder& servant() const { return servant_; }
    /// Returns the servant of a NewestPush, or NULL if older messages also count.
    const ServantHolder* numbered_servant() const { return numbered_servant_.get(); }
    /// Creates the servant by which a sender of another process makes this connector read a ring. Call it before the
    /// port has the connector.
    const ServantHolder& offer_ring(const PortBase& port);
    /// The connection uses a library's transport: its provider writes into this connector and calls the
    /// listeners itself.
    void set_provider(RegisteredInPortProvider provider) { provider_ = std::move(provider); }

  private:
    void takeArrived() override { receiver_->try_receive_from_ring(); }

    RegisteredInPortProvider provider_{nullptr, nullptr};
    bool owns_buffer_;
    std::shared_ptr<PushReceiver> receiver_;
    ServantHolder servant_;
    std::unique_ptr<ServantHolder> numbered_servant_, ring_servant_;
};

/// The connector if this side pulls, from the PullBuffer of an OutPort of this process or by CORBA. [port's reading
/// thread]
class InPortPullConnector : public InPortConnector {
  public:
    InPortPullConnector(InPortBase& port, ConnectorInfo& info, std::shared_ptr<PullBuffer> local);
    InPortPullConnector(InPortBase& port, ConnectorInfo& info, std::unique_ptr<RemoteSender> remote);

    using InPortConnector::read;
    /// Reads one message, the prefetched one first. Returns RECV_TIMEOUT if the sender does not answer.
    DataPortStatus read(ByteData& bytes) override;
    DataPortStatus disconnect() override { return DataPortStatus::PORT_OK; }
    /// Fetches a message from a sender in another process and keeps it for the next read(). Returns whether there is
    /// one. With `keep_failure`, the next read() returns the failure instead of asking the sender again.
    bool prefetch(bool keep_failure);

  private:
    DataPortStatus fetch(ByteData& bytes);
    std::optional<DataPortStatus> request_message(ByteData& bytes);

    std::shared_ptr<PullBuffer> local_;    // one of the two is NULL
    std::unique_ptr<RemoteSender> remote_; //
    std::chrono::milliseconds answer_timeout_{0};
    // The time limit of the probes after a missing answer. 0: the last request was answered.
    std::chrono::milliseconds probe_timeout_{0};
    std::chrono::steady_clock::time_point next_request_time_{}; // no request or probe before that
    std::optional<DataPortStatus> prefetched_status_;           // result of prefetch() for the next read()
    ByteData prefetched_bytes_;
    PeerErrors errors_;
    PortBuffer unused_buffer_; // getBuffer() must return one, though a remote sender fills none
};

} // namespace RTC
