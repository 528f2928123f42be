// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/operation.hpp"

#include <Method.h>

#include <string>
#include <vector>

namespace tandem::adaptor {

/// The types of an OPRoS method, as it describes them itself.
struct MethodTypes {
    struct Argument {
        wire::Type type;
        bool writable = false; ///< taken by a reference or pointer that is not const
    };
    std::vector<Argument> arguments;
    std::optional<wire::Type> result; ///< none for void

    /// The operation that the method stands for where no IDL says otherwise: writable arguments are inout.
    std::string operation_signature() const;
};

/// `expected`: the operation that the method stands for, if it is known, whose unions are looked for. Throws
/// wire::SignatureError, one line, when an argument or the result cannot cross a link.
MethodTypes describe_method(Method& method, const wire::Operation* expected = nullptr);

/// Which way each argument of a method goes when it is called as an operation.
using Directions = std::vector<wire::Direction>;

/// Finds the directions. An out or inout argument needs a writable one; or no argument is writable, and the result is a
/// structure of the operation's result and its inout and out arguments, or the only one of them. Throws wire::SignatureError, one line with both
/// signatures, when the method does not fit.
Directions match_method(const MethodTypes& method, const wire::Operation& operation);
/// The values of a request, and of a reply, as the method has them.
wire::Type request_of(const MethodTypes& method, const Directions& directions);
wire::Type reply_of(const MethodTypes& method, const Directions& directions);
/// Whether match_method() finds them.
bool fits(const MethodTypes& method, const wire::Operation& operation);

} // namespace tandem::adaptor
