// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/observe/followed_port.hpp"

#include <string>

namespace tandem::command {

/// The type of a port's messages in IDL (OMG IDL 4.2), for tools that decode CDR by it: one text without preprocessor
/// lines, all types that it needs, the message's own last.
struct MessageIdl {
    std::string name; ///< of the message, `RTC::TimedDoubleSeq`
    std::string text;
};

/// What has no counterpart in such tools is declared as what its bytes are: an enumeration as its number, a fixed and an
/// object reference as a string, an any as a structure of its signature and its bytes, wide characters and strings as
/// octets, a long double as two 64-bit words.
MessageIdl message_idl(const FollowedPort& port);
/// The same of any message. `type`: as a model calls it, `IDL:RTC/TimedDoubleSeq:1.0`; the modules are those in its name.
MessageIdl message_idl(const std::string& type, const wire::Type& message);

/// The message of a request or a reply, each member with a name: those that have none become `argument_N`, or `result`, which is
/// first in the reply of an operation with a result.
wire::Type with_member_names(wire::Type message, bool has_result);

} // namespace tandem::command
