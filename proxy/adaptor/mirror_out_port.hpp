// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/cdr_archive.hpp"
#include "proxy/link/channel.hpp"
#include "proxy/link/log_throttle.hpp"
#include "proxy/link/port_table.hpp"

#include <DataPortSource.h>
#include <InputDataPortInterface.h>
#include <OutputDataPort.h>

#include <optional>
#include <string>

namespace tandem::adaptor {

/// Mirrors an output data port of the peer. The one OPRoS input port connected to it polls the ring
/// itself, through the DataPortSource that this port is to it.
class MirrorOutPort final : public OutputDataPortInterface, private DataPortSource {
  public:
    MirrorOutPort(link::Port peer, link::ChannelReader& channel);
    ~MirrorOutPort() override;

    ReturnType push(opros_any&) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType pushData(unsigned char*, int) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType marshal(opros_any&, std::string&) override { return OPROS_UNSUPPORTED_METHOD; }

    bool checkType(opros_any&) override { return true; }
    /// Called at connection: learns the target's type and becomes its source. One target at a time.
    bool checkType(DataPort* target) override;
    std::string typeError() const override { return type_error_; }
    void removeConnection(IDataPortLink*) override { detach(); }
    void clearConnection() override { detach(); }

  private:
    opros::archive::iarchive* next() override;
    void done() override;
    bool large() const override { return record_bytes_ > link::large_message_bytes; }
    void undecodable(const std::string& why) override;
    void detach();

    const link::Port peer_;
    link::ChannelReader& channel_;
    InputDataPortInterface* target_ = nullptr;
    bool value_has_time_ = false;
    std::string type_error_;

    std::unique_lock<std::mutex> held_; ///< from next() to done(): the record must stay while it is read
    std::size_t record_bytes_ = 0;
    link::LogThrottle undecodable_;
    std::optional<CdrIarchive> archive_;
};

} // namespace tandem::adaptor
