// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/type.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::wire {

/// The direction of an argument, in the words of IDL.
enum class Direction { in, out, inout };

/// One argument of an operation.
struct Argument {
    Direction direction = Direction::in;
    Type type;
};

/// A user exception that an operation may raise.
struct ExceptionType {
    std::string id; ///< repository id, `IDL:M/TooFast:1.0`
    Type fields;    ///< a message
};

/// The arguments and the result of a service operation.
struct Operation {
    std::vector<Argument> arguments; ///< in the order of the IDL
    std::optional<Type> result;      ///< none for void
    bool oneway = false;             ///< the caller waits for no reply
    std::vector<ExceptionType> exceptions;

    // parse_operation() computes the following from the above, because calls need it again and again.
    std::string signature; ///< arguments and result in canonical form, `d>i&s:i`: both sides must agree
    Type request;          ///< the message of a request: in and inout arguments
    Type reply;            ///< the message of a reply: result, then inout and out arguments
    bool plain_request = false, plain_reply = false; ///< see is_plain()
    std::size_t max_request_bytes = 0;               ///< of a request with these types

    /// Returns the exception with this id; nullptr if the operation does not declare it.
    const ExceptionType* find_exception(std::string_view id) const;
};

/// Parses an operation's signature; docs/wire_format.md has the grammar. Throws SignatureError if it is malformed or has more
/// than 256 arguments or 64 exceptions.
Operation parse_operation(std::string_view signature);

/// Returns why an operation cannot cross: its first argument, result or exception that cannot, and the reason; empty if all
/// can.
std::string first_unsupported(const Operation& operation);

/// Returns the signature of one type; a structure includes its parentheses.
std::string type_signature(const Type& type);

} // namespace tandem::wire
