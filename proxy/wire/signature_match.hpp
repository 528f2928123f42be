// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/type.hpp"

#include <string_view>

namespace tandem::wire {

/// How a message of one signature becomes a message of another signature.
enum class SignatureMatch {
    equal,      ///< no change: the bytes are the same
    add_time,   ///< the receiver's leading `Time tm` is filled from the message header
    strip_time, ///< the sender's leading `Time tm` travels in the message header
    mismatch
};

/// Returns whether values of the two types have the same bytes. This holds for equal types, and for types that only one of
/// the models has: an enumeration fits int32 and uint32, a fixed a string, an any `(say)`, an object a string. Bounds are
/// not compared: see needs_check().
bool is_assignable(const Type& from, const Type& to);

/// Returns whether bytes of `from`, which fits, may contain values that `to` cannot have: beyond a bound, not an
/// enumerator, a text that is not a fixed, a discriminator without a case.
bool needs_check(const Type& from, const Type& to);

/// Compares the signatures of the sent and the received message by is_assignable(). Throws SignatureError if one of them
/// does not parse.
SignatureMatch match_signatures(std::string_view from, std::string_view to);

/// Returns true if the message begins with RTM's `Time tm`, the structure `(uu)`, and contains more than that.
bool is_timed(const Type& message);
bool is_timed(std::string_view signature); ///< Throws SignatureError.
/// Returns a timed message without its time.
Type without_time(const Type& message);

} // namespace tandem::wire
