// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::wire {

/// A conversion that is impossible. what() is one line that names the field, both types and what to do.
class ConversionError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// What a user asks for between the sent and the received type, in the syntax of `convert.PORT`:
///
///     widen; narrow; reorder; positions; drop tm; set tm; drop PATH
///     PATH: default VALUE        PATH: from SOURCE          PATH: count SOURCE
///     PATH: from SOURCE first A B                           PATH: count SOURCE per A B
///     refuse SOURCE WORD ...; refuse SOURCE unless WORD ...
///     PATH: deg->rad             PATH: * 0.125              PATH: from SOURCE deg->rad
///
/// PATH names a field of the receiver, SOURCE, A and B one of the sender: `velocity.va`, or by position `1.3`.
struct ConversionRequest {
    struct Rule {
        std::string target, source;          ///< no source: the field with the same path
        std::optional<std::string> constant; ///< the field's value in every message
        bool count = false;                  ///< the field's value is the number of elements of the source
        /// Fields of the sender, whose product limits the field to that many first elements of the source. With `count`:
        /// the field is the number of elements divided by this product.
        std::vector<std::string> extent;
        double factor = 1;
    };
    /// A message is an error if its field contains one of the words, in upper or lower case, or equals that number.
    /// With `unless`: if it does not.
    struct Refusal {
        std::string source;
        std::vector<std::string> words;
        bool unless = false;
    };
    bool widen = false;     ///< to a type that has each value of the sender's
    bool narrow = false;    ///< to any number type; a value that does not fit is an error of that message
    bool reorder = false;   ///< fields are found by name
    bool positions = false; ///< fields are found by position, whatever their names
    bool drop_time = false, set_time = false;
    std::vector<std::string> dropped; ///< fields of the sender that the receiver does not have
    std::vector<Rule> rules;
    std::vector<Refusal> refusals;

    bool empty() const;
    const Rule* find(std::string_view target) const;
};

/// Throws ConversionError naming the item that is not understood.
ConversionRequest parse_conversion_request(std::string_view text);

} // namespace tandem::wire
