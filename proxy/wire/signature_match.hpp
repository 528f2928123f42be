// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/type.hpp"

#include <string_view>

namespace tandem::wire {

/// How a message of one signature is turned into one of another.
enum class SignatureMatch {
    equal,      ///< no change: the bytes are the same
    add_time,   ///< the receiver's leading `Time tm` is filled from the message header
    strip_time, ///< the sender's leading `Time tm` travels in the message header
    mismatch
};

/// Whether values of the two types have the same bytes: equal types, and those that only one of the models has:
/// an enumeration fits int32 and uint32, a fixed a string, an any `(say)`, an object a string. Bounds are not
/// compared: see needs_check().
bool is_assignable(const Type& from, const Type& to);

/// Whether bytes of `from`, which fits, may hold values that `to` cannot: beyond a bound, no enumerator, a text that
/// is no fixed, a discriminator without a case.
bool needs_check(const Type& from, const Type& to);

/// Compares the signature of what is sent with that of what is received, by is_assignable(). Throws SignatureError if
/// one of them does not parse.
SignatureMatch match_signatures(std::string_view from, std::string_view to);

/// True if the message begins with RTM's `Time tm`, the structure `(uu)`, and holds more than that.
bool is_timed(const Type& message);
bool is_timed(std::string_view signature); ///< Throws SignatureError.
/// The message, which is timed, without its time.
Type without_time(const Type& message);

} // namespace tandem::wire
