// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/typed/value_type.hpp"
#include "proxy/link/channel/channel.hpp"
#include "proxy/link/protocol/port_table.hpp"

#include <InputDataPortInterface.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// Mirrors an input data port of the peer for an engine of the public API alone: push() encodes the value into the link's
/// channel, in the pushing thread, and never blocks. Several ports may push here, of types of their own.
class TypedInPort final : public InputDataPortInterface {
  public:
    /// `peer` is the port's entry in the peer's table; `convert` as check_type() takes it. The channel must outlive this
    /// port.
    TypedInPort(link::Port peer, link::ChannelWriter& channel, std::string convert = "");

    /// OPROS_OUT_OF_RESOURCES: no peer, or no room; OPROS_BAD_INPUT_PARAMETER: this value cannot cross, which is
    /// counted as a dropped message.
    ReturnType push(opros_any& value) override;
    ReturnType push(opros::archive::iarchive&) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType pushData(unsigned char*, int) override { return OPROS_UNSUPPORTED_METHOD; }

    /// Called by the source when the engine connects it, with a sample of what will be pushed: its signature must match
    /// the peer's. Logs a line if it does not.
    bool checkType(opros_any& sample) override;
    bool checkType(DataPort*) override { return true; }
    /// Why the first connection that was refused was refused; empty if there is none.
    std::string first_refusal() const;

  private:
    struct Encoding {
        const ValueType* type = nullptr;
        TypeCheck check;
    };
    Encoding* find_encoding(opros_any& value);
    bool send_converted(opros_any& value, Encoding& encoding);

    const link::Port peer_;
    link::ChannelWriter& channel_;
    const std::string convert_;
    mutable std::mutex mutex_;                         ///< the two below
    std::vector<std::unique_ptr<Encoding>> encodings_; ///< of the connected ports; only appended to
    std::string first_refusal_;

    std::mutex conversion_mutex_; ///< the two below, and the conversions
    wire::MessageBuffer encoded_; ///< a value before it is converted; kept for its memory
    std::size_t converted_bytes_ = 0;
};

} // namespace tandem::adaptor
