// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/log_throttle.hpp"
#include "proxy/adaptor/archive/cdr_archive.hpp"
#include "proxy/link/channel/channel.hpp"
#include "proxy/link/protocol/port_table.hpp"

#include <DataPortSource.h>
#include <InputDataPortInterface.h>
#include <OutputDataPort.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// Mirrors an output data port of the peer. It pushes nothing: the one OPRoS input port that is connected with
/// it reads the ring of the link in its component's own thread, through the DataPortSource that this port is
/// to it. An event-driven consumer is told by the link's doorbell when to read.
class MirrorOutPort final : public OutputDataPortInterface, private DataPortSource {
  public:
    /// Sets who is told of arrived messages, or nobody with nullptr. On return the last one is not in use.
    using SetListener = std::function<void(DataPortListener*)>;

    /// `peer` is the port's entry in the peer's table. The channel must outlive this port.
    MirrorOutPort(link::Port peer, link::ChannelReader& channel, SetListener set_listener);
    ~MirrorOutPort() override;

    // Values come from the link only.
    ReturnType push(opros_any&) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType pushData(unsigned char*, int) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType marshal(opros_any&, std::string&) override { return OPROS_UNSUPPORTED_METHOD; }

    bool checkType(opros_any&) override { return true; }
    /// Called when the host connects this port: compares the target's type with the peer's signature and
    /// becomes the target's source. One target at a time, because a ring has one reader.
    bool checkType(DataPort* target) override;
    std::string typeError() const override { return type_error_; }
    /// Each connection that was refused: why.
    const std::vector<std::string>& refusals() const { return refusals_; }
    void removeConnection(IDataPortLink*) override { detach(); }
    void clearConnection() override { detach(); }

  private:
    // DataPortSource, called by the target under its own lock: one thread at a time.
    opros::archive::iarchive* next() override;
    void done() override;
    bool setListener(DataPortListener* listener) override;
    void undecodable(const std::string& why) override;
    void detach();

    const link::Port peer_;
    link::ChannelReader& channel_;
    const SetListener set_listener_;
    InputDataPortInterface* target_ = nullptr;
    DataPortListener* listener_ = nullptr;
    bool value_has_time_ = false; ///< the OPRoS type begins with RTM's time, which the message header carries
    std::string type_error_;
    std::vector<std::string> refusals_;

    /// From next() to done(): the message's memory must not be reused while it is decoded.
    link::ChannelReader::Lock channel_lock_;
    std::size_t message_bytes_ = 0; ///< of the last message
    process::LogThrottle undecodable_;
    std::optional<CdrIarchive> archive_;
};

} // namespace tandem::adaptor
