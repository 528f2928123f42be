// SPDX-License-Identifier: Apache-2.0
// The other end of a data connection when it is in another process, by interface type: corba_cdr,
// data_service.
#pragma once
#include <chrono>
#include <memory>
#include <optional>
#include <rtm/ByteData.h>
#include <rtm/DataPortStatus.h>
#include <rtm/RTC.h>
#include <string>

namespace RTC {

/// Takes messages. One caller at a time.
class RemoteReceiver {
  public:
    virtual ~RemoteReceiver() = default;
    /// Nothing: no answer in time, and nobody knows whether the message arrives. CONNECTION_LOST: there is no
    /// such object any more. SEND_TIMEOUT: its buffer was full for too long, as it says itself.
    virtual std::optional<DataPortStatus> put(const ByteData& bytes) = 0;
    /// Bound of each following call; at first it is the ORB's.
    virtual void setTimeout(std::chrono::milliseconds timeout) = 0;
    /// What the profile of a connection offers; NULL when that is nothing for this interface type.
    static std::unique_ptr<RemoteReceiver> find(const ConnectorProfile& profile,
                                                const std::string& interface_type);
};

/// Gives messages.
class RemoteSender {
  public:
    virtual ~RemoteSender() = default;
    /// RECV_EMPTY: it has none. Nothing, CONNECTION_LOST: as above.
    virtual std::optional<DataPortStatus> get(ByteData& bytes) = 0;
    /// False: no answer in time. Takes no message.
    virtual bool isResponding() = 0;
    virtual void setTimeout(std::chrono::milliseconds timeout) = 0;
    static std::unique_ptr<RemoteSender> find(const ConnectorProfile& profile,
                                              const std::string& interface_type);
};

/// The interface type that carries a connection between processes: data_service if that is what its
/// properties ask for, else corba_cdr.
std::string corba_interface_type(const coil::Properties& connector_properties);

} // namespace RTC
