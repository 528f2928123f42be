// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// A type signature is one string that describes a CDR payload, for example `(uu)ad` for RTC::TimedDoubleSeq. The alphabet
// is that of the D-Bus specification ("Type System", signature strings), with the same type codes b y n q i u x t d s o v a
// ( ), and more where CDR has more. docs/wire_format.md has the whole alphabet.
namespace tandem::wire {

/// A signature that does not parse. what() is one line with the signature, the expected text and the place.
class SignatureError : public std::runtime_error {
  public:
    explicit SignatureError(const std::string& text) : runtime_error(text), reason_(text) {}
    /// `reason` says what is wrong without the signature.
    SignatureError(const std::string& text, std::string reason)
        : runtime_error(text), reason_(std::move(reason)) {}
    const std::string& reason() const { return reason_; }

  private:
    std::string reason_;
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
    long_double = 'D',
    wide_character = 'W',
    enumeration = 'e', ///< its number, as uint32
    string = 's',
    wide_string = 'w',
    fixed = 'F', ///< crosses as a string, `12.34`
    any = 'v',   ///< crosses as the value's signature, a string, and its CDR, a sequence of octets
    object = 'o',
    sequence = 'a',    ///< one child, the element
    array = '[',       ///< one child, the element, and a count
    structure = '(',   ///< children are the members
    union_type = '<',  ///< children are the discriminator and the cases
    unsupported = '?', ///< cannot cross; `name` says why
};

/// One node of a parsed signature. A message is a structure whose children are its members.
struct Type {
    Kind kind = Kind::structure;
    /// Array: number of elements. Sequence or string: the bound, 0: none. Enumeration: number of enumerators, 0: unknown.
    /// Fixed: number of digits.
    std::uint32_t count = 0;
    std::vector<Type> children;
    std::uint32_t scale = 0; ///< of a fixed: digits after the point
    std::string name{};      ///< of a member; empty if unknown; ignored by comparisons
    /// Of a union's case: the discriminator's values, those above INT64_MAX as negative ones; none: all others.
    std::vector<std::int64_t> labels{};
    /// Of the value of an any: repository ids of its typedefs from the outside in, and of the type itself. After that of
    /// an enumeration: a space and its enumerators, separated by commas. Ignored by comparisons.
    std::vector<std::string> ids{};

    bool operator==(const Type& other) const {
        return kind == other.kind && count == other.count && scale == other.scale && labels == other.labels &&
               children == other.children;
    }
};

/// Parses a message signature into a structure of its members. Drops parentheses around the whole signature, because a
/// structure of one structure is encoded the same. Throws SignatureError, including for more than 32 levels of nesting, 4096
/// members or 2^24 elements of an array, because signatures come from other processes.
Type parse_signature(std::string_view signature);

/// Parses the one type, or the member with its name, whose signature begins at `position`, and moves `position` past it.
/// Throws SignatureError.
Type parse_next_type(std::string_view text, std::size_t& position);

/// Returns the signature of a message without the outer parentheses and without names of members: signatures of equal types
/// are equal.
std::string to_signature(const Type& message);
/// Returns the signature with the names of members, each in braces before its type: `{tm}({sec}u{nsec}u){data}ad`.
std::string to_named_signature(const Type& message);

/// Returns the signature of an any's value, with names and ids: `{IDL:RTC/Time:1.0}({sec}u{nsec}u)`. It is empty for
/// null, a structure without members. The reverse throws SignatureError, and reads a list of members as their structure.
std::string to_any_signature(const Type& value);
Type parse_any_signature(std::string_view signature);

/// Returns the text of a union's label: that of its unsigned number if the discriminator is one of 64 bits.
std::string label_text(Kind discriminator, std::int64_t label);

/// Returns the size of a primitive in CDR, in bytes. It is also its alignment, except for long double (8). 0 for other kinds.
/// A wide character is not a primitive: its length precedes it.
std::size_t primitive_size(Kind kind);
std::size_t primitive_alignment(Kind kind);

/// Returns whether the type, or a type that it contains, is of this kind.
bool contains(const Type& type, Kind kind);

/// Returns whether values of the type have the same bytes in CORBA's own CDR, in the machine's byte order, and need no
/// check beyond those of their reader. This holds for all types except those that cross in another form (see Kind), and
/// enumerations, whose number is checked.
bool is_plain(const Type& type);

/// Returns the number of bytes that each message of the type takes in CDR; nothing if it depends on the values, or for an
/// array of non-primitives.
std::optional<std::size_t> fixed_bytes(const Type& message);

/// Returns an upper bound of the bytes that a value takes in CDR, including padding; infinity if the type sets no bound
/// (strings, sequences). A double, because the product of nested arrays may exceed any integer.
double max_encoded_bytes(const Type& type);

} // namespace tandem::wire
