// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/type.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::wire {

/// Which way an argument travels; the words are those of IDL.
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

/// What a service operation takes and gives.
struct Operation {
    std::vector<Argument> arguments; ///< in the order of the IDL
    std::optional<Type> result;      ///< none for void
    bool oneway = false;             ///< the caller waits for no reply
    std::vector<ExceptionType> exceptions;

    // Made from the above by parse_operation(), since calls need them again and again.
    std::string
        signature; ///< arguments and result in canonical form, `d>i&s:i`: what two sides must agree on
    Type request;  ///< the message of a request: in and inout arguments
    Type reply;    ///< the message of a reply: result, then inout and out arguments
    bool plain_request = false, plain_reply = false; ///< see is_plain()
    std::size_t max_request_bytes = 0;               ///< of a request as these types say

    /// The exception of that id; nullptr when the operation does not declare it.
    const ExceptionType* find_exception(std::string_view id) const;
};

/// Parses an operation's signature, whose grammar is in docs/wire_format.md. Throws SignatureError, also beyond 256
/// arguments or 64 exceptions.
Operation parse_operation(std::string_view signature);

/// Why an operation cannot cross: the argument, result or exception and the reason, of the first with a type that
/// cannot; empty if there is none.
std::string first_unsupported(const Operation& operation);

/// The signature of one type, a structure with its parentheses.
std::string type_signature(const Type& type);

} // namespace tandem::wire
