// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tandem::wire {

/// How a message of one signature becomes one of another.
enum class SignatureMatch {
    equal,      ///< byte for byte
    add_time,   ///< the receiver's leading `Time tm` is filled from the message header
    strip_time, ///< the sender's leading `Time tm` travels in the message header
    mismatch
};

/// Compares two message signatures; throws SignatureError if one does not parse.
SignatureMatch match_signatures(std::string_view from, std::string_view to);

/// True if the message starts with RTM's `Time tm`, the structure `(uu)`, and holds more than that.
bool is_timed(std::string_view signature);

/// Arguments and result of an operation signature `ss:d`; throws SignatureError without exactly one colon.
struct Operation {
    std::string arguments, result;
    bool operator==(const Operation&) const = default;
};
Operation parse_operation_signature(std::string_view signature);

} // namespace tandem::wire
