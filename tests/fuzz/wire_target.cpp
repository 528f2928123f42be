// SPDX-License-Identifier: Apache-2.0
// Signatures, conversion requests and messages that another process wrote: each is an error or a result, and nothing
// beyond the bytes is read.
#include "proxy/wire/conversion/conversion.hpp"
#include "proxy/wire/signature_match.hpp"
#include "proxy/wire/type_text.hpp"

#include <cstdint>
#include <string>
#include <vector>

using namespace tandem::wire;

namespace {

constexpr const char* signatures[] = {"{a}f{s}s{l}a({x}d{n}s){m}[3]n",
                                      "{m}[3]i{l}a({n}s#4{x}d){s}s#9{a}d",
                                      "<e#3;0={i}i;1,2={s}ad;*=(sv)>aw",
                                      "bcynqiuxtfdDWe#3swF5,2v",
                                      "a#3a#2[2](F5,2<b;1=s>)W",
                                      "(uu)({position}({x}d{y}d){heading}d)",
                                      "{w}i{h}q{s}s{x}ay",
                                      "{s}s{w}i{n}t{x}ay"};
constexpr const char* requests[] = {"",
                                    "narrow",
                                    "narrow; reorder",
                                    "positions",
                                    "widen; a: * 2; s: default none",
                                    "x: count l; drop a",
                                    "narrow; refuse s jp 3; w: from w; n: count x per w h",
                                    "narrow; refuse s p; h: from w; w: from w; x: from x first w n"};

/// Takes bytes off the front of the input.
class Bytes {
  public:
    Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
    std::size_t below(std::size_t limit) { return take() % limit; }
    std::string text() {
        std::string text;
        for (std::size_t count = below(40); count > 0; --count) text += static_cast<char>(take());
        return text;
    }
    /// One of the examples, now and then with a byte changed, or a text of any bytes.
    template <std::size_t n>
    std::string example(const char* const (&examples)[n]) {
        if (below(8) == 0) return text();
        std::string chosen = examples[below(n)];
        if (!chosen.empty() && below(4) == 0) chosen[below(chosen.size())] = static_cast<char>(take());
        return chosen;
    }
    std::vector<std::byte> rest() const {
        const auto* begin = reinterpret_cast<const std::byte*>(data_);
        return {begin, begin + size_};
    }

  private:
    std::uint8_t take() {
        if (size_ == 0) return 0;
        --size_;
        return *data_++;
    }
    const std::uint8_t* data_;
    std::size_t size_;
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes input(data, size);
    try {
        const Type from = parse_signature(input.example(signatures)),
                   to = parse_signature(input.example(signatures));
        if (parse_signature(to_named_signature(from)) != from) __builtin_trap();
        match_signatures(to_signature(from), to_signature(to));
        first_difference(from, to, true);
        first_unsupported(to);
        max_encoded_bytes(to);
        Conversion conversion(from, to, parse_conversion_request(input.example(requests)), true);
        const auto message = input.rest(); // of its exact size, for the sanitizer
        std::vector<std::byte> converted;
        CdrWriter out(converted);
        const bool ok = conversion.run(CdrReader(message), out);
        if (!ok && conversion.error().empty()) __builtin_trap();
        CdrReader in(message);
        skip_value(from, in);
    } catch (const SignatureError&) {
    } catch (const ConversionError&) {
    }
    return 0;
}
