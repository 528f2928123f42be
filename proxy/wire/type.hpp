// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

// Type signatures: one short string that says what a CDR payload holds, e.g. `(uu)ad` for RTC::TimedDoubleSeq.
// The alphabet is that of the D-Bus specification ("Type System", signature strings), which has the same type
// codes b y n q i u x t d s a ( ). Added are c (char), f (float), w (wide string) and [N] (fixed array); left
// out are D-Bus's o, g, v, h and { }. The whole alphabet is in this folder's README.
namespace tandem::wire {

/// A signature that does not parse; what() is one line with the signature, what was expected and where.
class SignatureError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The kind of a type; the value is its code in a signature.
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

/// One node of a parsed signature. A message is a structure whose children are its members.
struct Type {
    Kind kind = Kind::structure;
    std::uint32_t count = 0; ///< elements of an array
    std::vector<Type> children;

    bool operator==(const Type&) const = default;
};

/// Parses a message signature into a structure of its members. Parentheses around the whole are dropped, since
/// a structure of one structure is encoded the same. Throws SignatureError, also beyond 32 levels of nesting,
/// 4096 members or an array of 2^24: signatures come from other processes.
Type parse_signature(std::string_view signature);

/// The signature of a type; of a message (top-level structure) without the outer parentheses.
std::string to_signature(const Type& message);

/// Bytes of a primitive in CDR, which is also its alignment; 0 for everything else.
std::size_t primitive_size(Kind kind);

/// An upper bound of the bytes that a value takes in CDR, padding included; infinity when the type sets no
/// bound (strings, sequences). In double, because the product of nested arrays may exceed any integer.
double max_encoded_bytes(const Type& type);

} // namespace tandem::wire
