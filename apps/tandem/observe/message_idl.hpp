// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/observe/followed_port.hpp"

#include <string>

namespace tandem::command {

/// The type of a port's messages in IDL (OMG IDL 4.2), for tools that decode CDR with it. The text has no
/// preprocessor lines and defines all needed types, the message's type last.
struct MessageIdl {
    std::string name; ///< of the message, `RTC::TimedDoubleSeq`
    std::string text;
};

/// Returns the IDL. Types that such tools do not know are declared by their bytes: an enumeration as a
/// number, fixed and object references as strings, an any as a structure of signature and bytes, wide
/// characters and strings as octets, a long double as two 64-bit words.
MessageIdl message_idl(const FollowedPort& port);
/// Returns the IDL of any message. `type`: a model's name such as `IDL:RTC/TimedDoubleSeq:1.0`, which
/// determines the modules.
MessageIdl message_idl(const std::string& type, const wire::Type& message);

/// Returns the message type of a request or reply with all members named. Unnamed members become
/// `argument_N`, or `result`, which comes first in the reply of an operation with a result.
wire::Type with_member_names(wire::Type message, bool has_result);

} // namespace tandem::command
