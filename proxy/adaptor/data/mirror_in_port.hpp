// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/rt/rehearsal.hpp"
#include "proxy/adaptor/archive/refusal_record.hpp"
#include "proxy/adaptor/archive/type_check.hpp"
#include "proxy/link/channel/channel.hpp"
#include "proxy/link/protocol/port_table.hpp"

#include <InputDataPort.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// Mirrors an input data port of the peer: an OPRoS component's push() encodes the value into the link's channel, in the
/// pushing thread, and never blocks. The channel's ring overwrites old messages, so a short message is encoded into a
/// buffer of the ring and copied from there when it is published. A message that is too long for the ring is encoded in the
/// chunk of shared memory in which it travels. Several ports with different types may push here.
class MirrorInPort final : public InputDataPortInterface, public rt::Rehearsable, public RefusalRecord {
  public:
    /// `peer` is the port's entry in the peer's table; `convert` is that of check_type(). The channel must outlive this
    /// port.
    MirrorInPort(link::Port peer, link::ChannelWriter& channel, std::string convert = "");

    /// Returns OPROS_OUT_OF_RESOURCES if there is no room, and OPROS_BAD_INPUT_PARAMETER if this value
    /// cannot cross, which counts as a dropped message.
    ReturnType push(opros_any& value) override;
    ReturnType push(opros::archive::iarchive&) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType pushData(unsigned char*, int) override { return OPROS_UNSUPPORTED_METHOD; }

    /// Called when the host connects this port, with a sample of the values to push. Returns whether its signature matches
    /// the peer's.
    bool checkType(opros_any& sample) override;
    bool checkType(DataPort*) override { return true; }
    std::string typeError() const override { return type_error_; }

  private:
    struct Encoding {
        std::string type; ///< of the values
        TypeCheck check;
        bool converts = false; ///< a value is converted or checked before it is sent
        bool plain = false;    ///< a message is exactly the value's CDR
    };
    Encoding* find_encoding_by_name(const opros_any& value);
    ReturnType push_by_archive(opros_any& value);
    ReturnType push_converted(opros_any& value, TypeCheck& check);
    ReturnType result_of(bool sent) const {
        return channel_.is_success(sent) ? OPROS_SUCCESS : OPROS_OUT_OF_RESOURCES;
    }

    const link::Port peer_;
    link::ChannelWriter& channel_;
    const std::string convert_;
    std::mutex encodings_mutex_;
    std::vector<std::unique_ptr<Encoding>> encodings_; ///< of the connected ports; only appended to
    std::atomic<Encoding*> sole_encoding_{nullptr};    ///< nullptr: none, or several
    std::string type_error_;

    std::mutex conversion_mutex_;     ///< the two below, and the conversions
    wire::MessageBuffer encoded_;     ///< a value before its conversion; kept for its memory
    std::size_t converted_bytes_ = 0; ///< of the last message
};

} // namespace tandem::adaptor
