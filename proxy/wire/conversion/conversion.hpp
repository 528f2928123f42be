// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/cdr.hpp"
#include "proxy/wire/conversion/conversion_request.hpp"
#include "proxy/wire/type.hpp"

#include <memory>
#include <string>
#include <vector>

namespace tandem::wire {

/// One step of a conversion: makes one field, or several of one kind that lie in a row, of the receiver's message.
struct ConversionStep {
    enum class Op {
        copy,     ///< `count` primitives of one kind, as they are
        number,   ///< `count` numbers, to another kind or by a factor
        checked,  ///< an enumeration, a fixed, a wide character or an any, with a check of its value
        text,     ///< a string or wide string of at most `count`
        sequence, ///< at most `count` elements
        array,    ///< `count` elements
        structure,
        choice,   ///< a union: the discriminator, then `frame` + the case's index
        constant, ///< `value`
        length,   ///< the number of elements of the sequence at `slot`, for each of `extent` if it has fields
        refused   ///< makes nothing: an error if the field at `slot` has one of the words
    };
    Op op = Op::copy;
    Type from, to;
    std::uint32_t count = 1;
    double factor = 1;
    int slot = -1; ///< the source field's, if fields are not made in the order in which they come
    std::size_t frame =
        0; ///< of the elements of a sequence or array that are no primitives; of a union's first case
    std::string value, path;
    /// Numbers of the sender, by their slots, whose product is how many elements a sequence takes from the source.
    struct Extent {
        std::vector<std::size_t> slots;
        std::vector<Kind> kinds;
        std::string text; ///< `width x height`
    };
    Extent extent;
    std::vector<std::string> words;
};

/// What makes one structure: the message, or an element of a sequence.
struct ConversionFrame {
    /// The sender's fields, in order, if their places have to be found first: field i goes to slot first_slot + i.
    std::vector<Type> scan;
    std::size_t first_slot = 0;
    std::vector<ConversionStep> steps;
};

/// Turns messages of one type into messages of another one, CDR into CDR. Compiled once, when two ports are connected.
/// Running it allocates nothing. [one thread at a time]
class Conversion {
  public:
    /// Throws ConversionError if the types do not fit and the request does not say how to make them fit. Neither
    /// message has the leading time. `sends`: this process is the sender, for the message.
    Conversion(const Type& from, const Type& to, const ConversionRequest& request, bool sends);

    /// True if the bytes stay as they are and need no check.
    bool is_identity() const { return identity_; }
    /// Converts one message. False: the message is none, or holds a value that the receiver's type does not; then
    /// error() is one line.
    bool run(CdrReader in, CdrWriter& out);
    const std::string& error() const { return error_; }

  private:
    friend class ConversionCompiler;
    bool run_frame(std::size_t frame, CdrReader& in, CdrWriter& out);
    bool run_step(const ConversionStep& step, CdrReader& in, CdrWriter& out);
    bool run_numbers(const ConversionStep& step, std::uint32_t count, CdrReader& in, CdrWriter& out);
    bool run_checked(const ConversionStep& step, CdrReader& in, CdrWriter& out);
    bool run_text(const ConversionStep& step, CdrReader& in, CdrWriter& out);
    bool run_elements(const ConversionStep& step, std::uint32_t count, CdrReader& in, CdrWriter& out);
    bool run_choice(const ConversionStep& step, CdrReader& in, CdrWriter& out);
    bool run_constant(const ConversionStep& step, CdrWriter& out);
    bool run_length(const ConversionStep& step, CdrReader& in, CdrWriter& out);
    bool run_refused(const ConversionStep& step, CdrReader& in);
    bool take_first(const ConversionStep& step, std::uint32_t& count, const CdrReader& in);
    long double product(const ConversionStep::Extent& extent, CdrReader in) const;
    std::string describe(const ConversionStep::Extent& extent, CdrReader in) const;
    bool fail(const ConversionStep& step, const std::string& what);

    std::vector<ConversionFrame> frames_; ///< the first one is the message
    std::vector<std::size_t> slots_;      ///< positions of the sender's fields
    bool identity_ = false;
    std::string error_;
};

/// Passes over one value. in.ok() is false if there is none. Nothing is allocated.
void skip_value(const Type& type, CdrReader& in);

} // namespace tandem::wire
