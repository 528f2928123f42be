// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/link/channel.hpp"
#include "proxy/link/port_table.hpp"

#include <InputDataPort.h>

#include <string>

namespace tandem::adaptor {

/// Mirrors an input data port of the peer: what an OPRoS component pushes here is encoded straight into
/// the ring, in the pushing thread. Never blocks.
class MirrorInPort final : public InputDataPortInterface {
  public:
    MirrorInPort(link::Port peer, link::ChannelWriter& channel);

    ReturnType push(opros_any& value) override;
    ReturnType push(opros::archive::iarchive&) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType pushData(unsigned char*, int) override { return OPROS_UNSUPPORTED_METHOD; }

    /// Called at connection with a sample of what will be pushed: its signature must fit the peer's.
    bool checkType(opros_any& sample) override;
    bool checkType(DataPort*) override { return true; }
    std::string typeError() const override { return type_error_; }

  private:
    const link::Port peer_;
    link::ChannelWriter& channel_;
    bool value_has_time_ = false;
    std::string type_error_;
};

} // namespace tandem::adaptor
