// SPDX-License-Identifier: Apache-2.0
// A component of this program with one port of a type that is known at run time only, for cat and inject.
#pragma once
#include "apps/tandem/rtm/running/running_commands.hpp"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <rtm/DataFlowComponentBase.h>
#include <rtm/Manager.h>

namespace tandem::command {

/// Messages as they came, in order. [any-thread]
class SampleQueue : public RTC::ConnectorDataListener {
  public:
    ReturnCode operator()(RTC::ConnectorInfo& info, RTC::ByteData& data, const std::string& type) override;
    /// The next one; false when none comes within the time.
    bool next(RTC::ByteData& bytes, std::chrono::milliseconds timeout);

  private:
    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<RTC::ByteData> waiting_;
};

class UntypedInPort : public RTC::InPortBase {
  public:
    UntypedInPort(const char* name, const char* type);
    bool read(std::string name = "") override;
    SampleQueue& samples() { return *samples_; }

  private:
    SampleQueue* samples_; // the port's
};

class UntypedOutPort : public RTC::OutPortBase {
  public:
    UntypedOutPort(const char* name, const char* type);
    bool write() override { return false; }
    /// Throws std::runtime_error when the connection does not take it.
    void send(const RTC::ByteData& bytes);
    bool littleEndian();
};

/// The data type of a port of the kind wanted (DataInPort, DataOutPort). Throws.
std::string data_type(const RemotePort& port, const std::string& kind);
/// Connects a port of ours; it is disconnected when this goes.
class PortConnection {
  public:
    PortConnection(const RemotePort& remote_port, RTC::PortBase& ours,
                   const std::vector<std::string>& properties, const char* name);
    ~PortConnection();
    PortConnection(const PortConnection&) = delete;
    PortConnection& operator=(const PortConnection&) = delete;

  private:
    RTC::PortBase& ours_;
    std::string id_;
};

/// True once SIGINT or SIGTERM has come; the first call installs the handlers.
bool interrupted();

} // namespace tandem::command
