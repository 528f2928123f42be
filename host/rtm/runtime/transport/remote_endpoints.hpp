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

/// The receiving end of a push connection. One caller at a time. Every call blocks up to the time limit.
class RemoteReceiver {
  public:
    virtual ~RemoteReceiver() = default;
    /// Sends one message. Returns an empty result if there is no answer within the time limit; whether the message
    /// arrives is then unknown. CONNECTION_LOST: the object does not exist (any more). SEND_FULL, SEND_TIMEOUT: the
    /// receiver's buffer has refused the message. A network failure counts as no answer. If a process of another
    /// machine does not answer in time, but its machine does, the result is CONNECTION_LOST; the process may still take
    /// the message.
    virtual std::optional<DataPortStatus> put(const ByteData& bytes) = 0;
    /// Sends one message that needs no answer, without waiting. Returns false, without side effects, if that is not
    /// possible now; use put() then.
    virtual bool try_put(const ByteData&) { return false; }
    /// Sets the time limit of each following call. Before the first set_timeout() the ORB's limit applies.
    virtual void set_timeout(std::chrono::milliseconds timeout) = 0;
    /// Returns whether each call crosses a network.
    virtual bool is_on_another_machine() const { return false; }

    /// Returns the receiver that the InPort has published in the profile for this interface type, or NULL if there is
    /// none.
    static std::unique_ptr<RemoteReceiver> find(const ConnectorProfile& profile,
                                                const std::string& interface_type);
};

/// The sending end of a pull connection. One caller at a time. Every call blocks up to the time limit.
class RemoteSender {
  public:
    virtual ~RemoteSender() = default;
    /// Fetches one message. Returns RECV_EMPTY if the sender has none, and an empty result if there is no answer within
    /// the time limit. CONNECTION_LOST: the object does not exist (any more).
    virtual std::optional<DataPortStatus> get(ByteData& bytes) = 0;
    /// Returns whether the sender answers within the time limit. Takes no message from it.
    virtual bool responds() = 0;
    /// As for RemoteReceiver.
    virtual void set_timeout(std::chrono::milliseconds timeout) = 0;

    /// Returns the sender that the OutPort has published in the profile for this interface type, or NULL if there is
    /// none.
    static std::unique_ptr<RemoteSender> find(const ConnectorProfile& profile,
                                              const std::string& interface_type);
};

/// Returns the interface type that carries a connection between processes: data_service or shared_memory if the
/// connection's `interface_type` says so, else corba_cdr (also for `direct`, which works only within a process).
std::string corba_interface_type(const coil::Properties& connector_properties);

/// Returns the key under which a port publishes its object for that interface type. `side`: inport or outport.
std::string address_key(const std::string& interface_type, const char* side);

/// Returns the meaning of a call's exception: no answer in time (empty), CONNECTION_LOST if there is no such object, or
/// PORT_ERROR for an answer that is an error.
std::optional<DataPortStatus> status_of(const CORBA::SystemException& e);
/// Returns whether the object's process answers CORBA's ping. An error also counts as an answer. [any-thread; waits for
/// the process]
bool is_responding(CORBA::Object_ptr object);

void set_call_timeout(CORBA::Object_ptr object, std::chrono::milliseconds timeout);

} // namespace RTC
