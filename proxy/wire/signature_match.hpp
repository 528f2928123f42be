// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tandem::wire {

/// How a message of one signature is turned into one of another.
enum class SignatureMatch {
    equal,      ///< no change: the bytes are the same
    add_time,   ///< the receiver's leading `Time tm` is filled from the message header
    strip_time, ///< the sender's leading `Time tm` travels in the message header
    mismatch
};

/// Compares the signature of what is sent with that of what is received. Throws SignatureError if one of them
/// does not parse.
SignatureMatch match_signatures(std::string_view from, std::string_view to);

/// True if the message begins with RTM's `Time tm`, the structure `(uu)`, and holds more than that. Throws
/// SignatureError.
bool is_timed(std::string_view signature);

/// The two message signatures of an operation signature `arguments:result`, e.g. `ss:d`, in canonical form.
struct OperationSignature {
    std::string arguments, result;
    bool operator==(const OperationSignature&) const = default;
};
/// Throws SignatureError unless there is exactly one colon and both parts parse.
OperationSignature parse_operation_signature(std::string_view signature);

} // namespace tandem::wire
