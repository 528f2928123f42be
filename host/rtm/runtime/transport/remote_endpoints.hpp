// SPDX-License-Identifier: Apache-2.0
// The peer's end of a data connection when the peer is in another process. The interface types are those of
// OpenRTM-aist: corba_cdr (DataPort_OpenRTM.idl) and data_service (DataPort.idl), which carry the CDR of one
// message as an octet sequence, and shared_memory.
#pragma once
#include <chrono>
#include <memory>
#include <optional>
#include <rtm/ByteData.h>
#include <rtm/DataPortStatus.h>
#include <rtm/RTC.h>
#include <string>

namespace RTC {

/// The receiving end of a push connection. One caller at a time; every call blocks up to the time limit.
class RemoteReceiver {
  public:
    virtual ~RemoteReceiver() = default;
    /// Sends one message. Empty: no answer within the time limit, and whether the message arrives is unknown.
    /// CONNECTION_LOST: the object does not exist (any more). SEND_FULL, SEND_TIMEOUT: the receiver's buffer
    /// has refused the message. A network that is down is no answer; a process of another machine that does not
    /// answer in time, while its machine does, is CONNECTION_LOST: it may still take the message.
    virtual std::optional<DataPortStatus> put(const ByteData& bytes) = 0;
    /// Sends one message that needs no answer, without waiting. Returns false, without side effects, if that is not possible
    /// now; use put() then.
    virtual bool putAtOnce(const ByteData&) { return false; }
    /// The time limit of each following call; before the first setTimeout() the ORB's own limit holds.
    virtual void setTimeout(std::chrono::milliseconds timeout) = 0;
    /// Does each call cross a network?
    virtual bool isOnAnotherMachine() const { return false; }

    /// The receiver that the InPort has published in the profile for this interface type; NULL when there is
    /// none.
    static std::unique_ptr<RemoteReceiver> find(const ConnectorProfile& profile,
                                                const std::string& interface_type);
};

/// The sending end of a pull connection. One caller at a time; every call blocks up to the time limit.
class RemoteSender {
  public:
    virtual ~RemoteSender() = default;
    /// Fetches one message. RECV_EMPTY: the sender has none. Empty: no answer within the time limit.
    /// CONNECTION_LOST: the object does not exist (any more).
    virtual std::optional<DataPortStatus> get(ByteData& bytes) = 0;
    /// Does the sender answer within the time limit? Takes no message from it.
    virtual bool isResponding() = 0;
    /// As for RemoteReceiver.
    virtual void setTimeout(std::chrono::milliseconds timeout) = 0;

    /// The sender that the OutPort has published in the profile for this interface type; NULL when there is
    /// none.
    static std::unique_ptr<RemoteSender> find(const ConnectorProfile& profile,
                                              const std::string& interface_type);
};

/// The interface type that carries a connection between processes: data_service or shared_memory when the
/// connection's `interface_type` says so, else corba_cdr (also for `direct`, which works within a process only).
std::string corba_interface_type(const coil::Properties& connector_properties);

/// The key under which a port publishes its object for that interface type. `side`: inport or outport.
std::string address_key(const std::string& interface_type, const char* side);

/// What an exception of a call means: no answer in time (empty), CONNECTION_LOST when there is no such object,
/// or PORT_ERROR for an answer that is an error.
std::optional<DataPortStatus> status_of(const CORBA::SystemException& e);
/// Whether the object's process answers CORBA's ping; an error is an answer, too. [any-thread; waits for the process]
bool is_responding(CORBA::Object_ptr object);

void set_call_timeout(CORBA::Object_ptr object, std::chrono::milliseconds timeout);

} // namespace RTC
