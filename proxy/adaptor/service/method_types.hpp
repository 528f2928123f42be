// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/operation.hpp"

#include <Method.h>

#include <string>
#include <vector>

namespace tandem::adaptor {

/// The types of an OPRoS method, as the method describes them.
struct MethodTypes {
    struct Argument {
        wire::Type type;
        bool writable = false; ///< passed by a non-const reference or pointer
    };
    std::vector<Argument> arguments;
    std::optional<wire::Type> result; ///< none for void

    /// Returns the operation that the method stands for, unless the IDL says otherwise: writable arguments are inout.
    std::string operation_signature() const;
};

/// Returns the types of the method. `expected`: the operation that it stands for, if known; needed to recognize unions.
/// Throws wire::SignatureError, one line, if an argument or the result cannot cross a link.
MethodTypes describe_method(Method& method, const wire::Operation* expected = nullptr);

/// The direction of each argument of a method that is called as an operation.
using Directions = std::vector<wire::Direction>;

/// Finds the directions. An out or inout argument needs a writable one. Alternatively no argument is writable, and the
/// result is a structure of the operation's result and its inout and out arguments, or the only one of these. Throws
/// wire::SignatureError, one line with both signatures, if the method does not fit.
Directions match_method(const MethodTypes& method, const wire::Operation& operation);
/// Return the values of a request and of a reply, as the method has them.
wire::Type request_of(const MethodTypes& method, const Directions& directions);
wire::Type reply_of(const MethodTypes& method, const Directions& directions);
/// Returns whether match_method() succeeds.
bool fits(const MethodTypes& method, const wire::Operation& operation);

} // namespace tandem::adaptor
