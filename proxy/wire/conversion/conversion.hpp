// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/wire/cdr.hpp"
#include "proxy/wire/conversion/conversion_request.hpp"
#include "proxy/wire/type.hpp"

#include <memory>
#include <string>
#include <vector>

namespace tandem::wire {

/// One step of a conversion: creates one field, or several consecutive fields of one kind, of the receiver's message.
struct ConversionStep {
    enum class Op {
        copy,     ///< `count` primitives of one kind, unchanged
        number,   ///< `count` numbers, to another kind or by a factor
        checked,  ///< an enumeration, a fixed, a wide character or an any, whose value is checked
        text,     ///< a string or wide string of at most `count`
        sequence, ///< at most `count` elements
        array,    ///< `count` elements
        structure,
        choice,   ///< a union: the discriminator, then `frame` + the case's index
        constant, ///< `value`
        length,   ///< the number of elements of the sequence at `slot`, for each of `extent` if it has fields
        refused ///< creates nothing: an error if the field at `slot` has one of the words, or `unless` it has
    };
    Op op = Op::copy;
    Type from, to;
    std::uint32_t count = 1;
    double factor = 1;
    int slot = -1; ///< of the source field, if the order of the fields differs
    std::size_t frame =
        0; ///< of the elements of a sequence or array of non-primitives; of a union's first case
    std::string value, path;
    /// Slots of the sender's numbers whose product is the number of elements that a sequence takes from the source.
    struct Extent {
        std::vector<std::size_t> slots;
        std::vector<Kind> kinds;
        std::string text; ///< `width x height`
    };
    Extent extent;
    std::vector<std::string> words;
    bool unless = false;
};

/// The steps for one structure: the message, or an element of a sequence.
struct ConversionFrame {
    /// The sender's fields, in order, if their places must be found first: field i goes to slot first_slot + i.
    std::vector<Type> scan;
    std::size_t first_slot = 0;
    std::vector<ConversionStep> steps;
};

/// Converts messages of one type into messages of another type, CDR to CDR. Compiled once, when two ports are connected.
/// Running it allocates nothing. [one thread at a time]
class Conversion {
  public:
    /// Both messages are without the leading time. `sends`: this process is the sender; used in the error's text. Throws
    /// ConversionError if the types do not fit and the request does not make them fit.
    Conversion(const Type& from, const Type& to, const ConversionRequest& request, bool sends);

    /// Returns true if the bytes stay unchanged and need no check.
    bool is_identity() const { return identity_; }
    /// Converts one message. Returns false if the bytes are not such a message, or contain a value that the receiver's type
    /// does not have; then error() is one line.
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

    std::vector<ConversionFrame> frames_; ///< the first frame is the message
    std::vector<std::size_t> slots_;      ///< positions of the sender's fields
    bool identity_ = false;
    std::string error_;
};

/// Skips one value. in.ok() becomes false if there is none. Allocates nothing.
void skip_value(const Type& type, CdrReader& in);

} // namespace tandem::wire
