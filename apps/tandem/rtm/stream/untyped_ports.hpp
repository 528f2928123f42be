// SPDX-License-Identifier: Apache-2.0
// Ports of this program with data types that are known only at run time, for cat and inject. They transport unmodified
// CDR.
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

/// The samples that an InPort has received, in order. An ORB thread adds them, the main thread takes them. [any-thread]
class SampleQueue : public RTC::ConnectorDataListener {
  public:
    /// Called by the port for each sample. Keeps a copy, or drops the sample if the queue is full.
    ReturnCode operator()(RTC::ConnectorInfo& info, RTC::ByteData& data, const std::string& type) override;
    /// Takes the oldest sample. Returns false if none arrives in time.
    bool pop(RTC::ByteData& bytes, std::chrono::milliseconds timeout);

  private:
    std::mutex mutex_;
    std::condition_variable received_;
    std::deque<RTC::ByteData> queue_;
};

/// Accepts the data type given at construction. read() has no variable to read into; samples() has the data.
class UntypedInPort : public RTC::InPortBase {
  public:
    UntypedInPort(const char* name, const char* type);
    bool read(std::string name = "") override;
    SampleQueue& samples() { return *samples_; }
    /// With dataflow_type=pull: fetches up to 1000 samples from the sender. Blocks until the sender answers.
    void fetch();

  private:
    SampleQueue* samples_; // owned by the port's list of listeners
};

/// Counts the samples of an OutPort that receivers have accepted. [any-thread]
class DeliveryCounter : public RTC::ConnectorDataListener {
  public:
    ReturnCode operator()(RTC::ConnectorInfo& info, RTC::ByteData& data, const std::string& type) override;
    std::size_t count() const { return count_; }

  private:
    std::atomic<std::size_t> count_{0};
};

/// The connection no longer exists.
class ConnectionLost : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Sends CDR that the caller has encoded.
class UntypedOutPort : public RTC::OutPortBase {
  public:
    UntypedOutPort(const char* name, const char* type);
    bool write() override { return false; }
    /// Returns the number of sent samples that the receiver has accepted.
    std::size_t delivered() const;
    /// Throws std::runtime_error with the receiver's name if the connection refuses the sample, and ConnectionLost
    /// without one.
    void send(const RTC::ByteData& bytes, const std::string& receiver);
    /// Returns the byte order of the connection, in which samples must be encoded.
    bool is_little_endian();

  private:
    DeliveryCounter *pushed_, *pulled_; // owned by the port's list of listeners
};

/// Returns the repository id of a port's data type. Throws std::runtime_error if the port is not of this kind
/// (DataInPort, DataOutPort).
std::string require_data_type(const RemotePort& port, const std::string& kind);

/// A connection between a remote port and a port of this program, for the lifetime of the object. The constructor
/// throws std::runtime_error if the ports cannot be connected.
class PortConnection {
  public:
    /// `properties`: KEY=VALUE, see connection_properties(). Both ports must outlive the connection.
    PortConnection(const RemotePort& remote_port, RTC::PortBase& own_port,
                   const std::vector<std::string>& properties, const char* name);
    ~PortConnection();
    PortConnection(const PortConnection&) = delete;
    PortConnection& operator=(const PortConnection&) = delete;
    const std::string& id() const { return id_; }
    /// Returns false if the remote port has dropped the connection, perhaps silently. Returns true if it does not
    /// answer.
    bool exists_at_remote_port() const;

  private:
    RTC::PortService_var remote_;
    RTC::PortBase& own_port_;
    std::string id_;
};

/// Returns true after SIGINT, SIGTERM or SIGHUP. The first call installs the handlers. [main-thread]
bool interrupted();

} // namespace tandem::command
