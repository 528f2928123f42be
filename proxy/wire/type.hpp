// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::wire {

/// A signature that does not parse; what() names it and the place.
class SignatureError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

enum class Kind : char {
    boolean = 'b',
    character = 'c',
    octet = 'y',
    int16 = 'n',
    uint16 = 'q',
    int32 = 'i',
    uint32 = 'u',
    int64 = 'x',
    uint64 = 't',
    float32 = 'f',
    float64 = 'd',
    string = 's',
    wide_string = 'w',
    sequence = 'a', ///< one child, the element
    array = '[',    ///< one child, the element, and a count
    structure = '(' ///< children are the members
};

/// One node of a parsed signature.
struct Type {
    Kind kind = Kind::structure;
    std::uint32_t count = 0; ///< elements of an array
    std::vector<Type> children;

    bool operator==(const Type&) const = default;
};

/// Parses a message signature into a structure of its members; `(..)` around the whole is dropped.
/// Throws SignatureError; nesting is limited to 32, members to 4096.
Type parse_signature(std::string_view signature);

/// The signature of a type; of a message (top-level structure) without the outer parentheses.
std::string to_signature(const Type& message);

/// Bytes of a primitive in CDR, which is also its alignment; 0 for everything else.
std::size_t primitive_size(Kind kind);

/// Bytes that a value takes at most, padding included (rather too many than too few); infinity when the type
/// sets no bound.
double max_encoded_bytes(const Type& type);

} // namespace tandem::wire
