// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/adaptor/archive/refusal_record.hpp"
#include "proxy/adaptor/typed/value_type.hpp"
#include "proxy/link/channel/channel.hpp"
#include "proxy/link/protocol/port_table.hpp"

#include <InputDataPortInterface.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace tandem::adaptor {

/// Mirrors an input data port of the peer, for an engine with only the public API. push() encodes the value into the link's
/// channel, in the pushing thread, and never blocks. Several ports with different types may push here.
class TypedInPort final : public InputDataPortInterface, public RefusalRecord {
  public:
    /// `peer` is the port's entry in the peer's table; `convert` is that of check_type(). The channel must outlive this
    /// port.
    TypedInPort(link::Port peer, link::ChannelWriter& channel, std::string convert = "");

    /// Returns OPROS_OUT_OF_RESOURCES if there is no room, and OPROS_BAD_INPUT_PARAMETER if this value
    /// cannot cross, which counts as a dropped message.
    ReturnType push(opros_any& value) override;
    ReturnType push(opros::archive::iarchive&) override { return OPROS_UNSUPPORTED_METHOD; }
    ReturnType pushData(unsigned char*, int) override { return OPROS_UNSUPPORTED_METHOD; }

    /// Called by the source when the engine connects it, with a sample of the values to push. If its signature does not match
    /// the peer's, logs a line and returns false.
    bool checkType(opros_any& sample) override;
    bool checkType(DataPort*) override { return true; }

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
    std::mutex mutex_;                                 ///< the one below
    std::vector<std::unique_ptr<Encoding>> encodings_; ///< of the connected ports; only appended to

    std::mutex conversion_mutex_; ///< the two below, and the conversions
    wire::MessageBuffer encoded_; ///< a value before its conversion; kept for its memory
    std::size_t converted_bytes_ = 0;
};

} // namespace tandem::adaptor
