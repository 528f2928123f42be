// SPDX-License-Identifier: Apache-2.0
// Ports of this program whose data type is known at run time only, for cat and inject. They carry CDR as it is.
#pragma once
#include "apps/tandem/rtm/running/running_commands.hpp"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <rtm/DataFlowComponentBase.h>
#include <rtm/Manager.h>
#include <stdexcept>

namespace tandem::command {

/// The samples that an InPort has received, in order. Filled by a thread of the ORB, emptied by the main thread.
/// [any-thread]
class SampleQueue : public RTC::ConnectorDataListener {
  public:
    /// Called by the port for each sample that it receives; keeps a copy, or drops it if the queue is full.
    ReturnCode operator()(RTC::ConnectorInfo& info, RTC::ByteData& data, const std::string& type) override;
    /// Takes the oldest sample; false if none comes in time.
    bool pop(RTC::ByteData& bytes, std::chrono::milliseconds timeout);

  private:
    std::mutex mutex_;
    std::condition_variable received_;
    std::deque<RTC::ByteData> queue_;
};

/// Takes any data type that is named when it is made. read() has no variable to read into: samples() has the data.
class UntypedInPort : public RTC::InPortBase {
  public:
    UntypedInPort(const char* name, const char* type);
    bool read(std::string name = "") override;
    SampleQueue& samples() { return *samples_; }
    /// With dataflow_type=pull: fetches what the sender has, up to 1000 samples. Waits for its answers.
    void fetch();

  private:
    SampleQueue* samples_; // owned by the port's list of listeners
};

/// Counts the samples of an OutPort that receivers have taken. [any-thread]
class DeliveryCounter : public RTC::ConnectorDataListener {
  public:
    ReturnCode operator()(RTC::ConnectorInfo& info, RTC::ByteData& data, const std::string& type) override;
    std::size_t count() const { return count_; }

  private:
    std::atomic<std::size_t> count_{0};
};

/// There is no connection any more.
class ConnectionLost : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Sends CDR that the caller has encoded.
class UntypedOutPort : public RTC::OutPortBase {
  public:
    UntypedOutPort(const char* name, const char* type);
    bool write() override { return false; }
    /// How many of the samples that were sent the receiver has taken.
    std::size_t delivered() const;
    /// Throws std::runtime_error, with the receiver's name, if the connection refuses the sample, and ConnectionLost without one.
    void send(const RTC::ByteData& bytes, const std::string& receiver);
    /// The byte order that the connection has agreed on, in which samples are to be encoded.
    bool is_little_endian();

  private:
    DeliveryCounter *pushed_, *pulled_; // owned by the port's list of listeners
};

/// The repository id of a port's data type. Throws std::runtime_error if the port is not of the kind (DataInPort,
/// DataOutPort).
std::string require_data_type(const RemotePort& port, const std::string& kind);

/// A connection between a remote port and one of this program, for the lifetime of the object. The constructor throws
/// std::runtime_error if the ports cannot be connected.
class PortConnection {
  public:
    /// `properties`: KEY=VALUE, see connection_properties(). Both ports must outlive the connection.
    PortConnection(const RemotePort& remote_port, RTC::PortBase& own_port,
                   const std::vector<std::string>& properties, const char* name);
    ~PortConnection();
    PortConnection(const PortConnection&) = delete;
    PortConnection& operator=(const PortConnection&) = delete;
    const std::string& id() const { return id_; }
    /// Returns false if the remote port has dropped the connection, maybe silently. Returns true if it cannot be asked.
    bool exists_at_remote_port() const;

  private:
    RTC::PortService_var remote_;
    RTC::PortBase& own_port_;
    std::string id_;
};

/// True once SIGINT, SIGTERM or SIGHUP has come; the first call installs the handlers. [main-thread]
bool interrupted();

} // namespace tandem::command
