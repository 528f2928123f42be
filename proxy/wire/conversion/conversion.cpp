// SPDX-License-Identifier: Apache-2.0
#include "proxy/wire/conversion/conversion.hpp"

#include "proxy/wire/number.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace tandem::wire {
namespace {

using Op = ConversionStep::Op;

constexpr std::size_t wide_unit_bytes = 2, wide_character_bytes = 3;

/// Converts ASCII only, independent of the locale, which a component may have set.
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Returns the index of the case for this discriminator; the number of cases if there is none.
std::size_t case_index(const Type& type, std::int64_t discriminator) {
    std::size_t default_case = type.children.size() - 1;
    for (std::size_t i = 1; i < type.children.size(); ++i) {
        const auto& labels = type.children[i].labels;
        if (std::find(labels.begin(), labels.end(), discriminator) != labels.end()) return i - 1;
        if (labels.empty()) default_case = i - 1;
    }
    return default_case;
}

} // namespace

bool Conversion::run(CdrReader in, CdrWriter& out) {
    error_.clear();
    return run_frame(0, in, out);
}

bool Conversion::fail(const ConversionStep& step, const std::string& what) {
    error_ = fmt::format("field '{}' {}", step.path, what);
    return false;
}

bool Conversion::run_frame(std::size_t index, CdrReader& in, CdrWriter& out) {
    const ConversionFrame& frame = frames_[index];
    for (std::size_t i = 0; i < frame.scan.size(); ++i) {
        slots_[frame.first_slot + i] = in.position();
        skip_value(frame.scan[i], in);
    }
    const std::size_t end = in.position();
    for (const ConversionStep& step : frame.steps) {
        if (step.slot >= 0) in.seek(slots_[static_cast<std::size_t>(step.slot)]);
        if (!run_step(step, in, out)) return false;
        if (!in.ok()) return fail(step, "is missing: the message ends early or is damaged");
    }
    if (!frame.scan.empty()) in.seek(end);
    return true;
}

bool Conversion::run_step(const ConversionStep& step, CdrReader& in, CdrWriter& out) {
    switch (step.op) {
    case Op::copy:
    case Op::number:
        return run_numbers(step, step.count, in, out);
    case Op::checked:
        return run_checked(step, in, out);
    case Op::text:
        return run_text(step, in, out);
    case Op::sequence: {
        std::uint32_t count = in.get_count(1); // an element takes at least one byte
        if (!step.extent.slots.empty() && !take_first(step, count, in)) return false;
        if (step.count != 0 && count > step.count)
            return fail(step, fmt::format("has {} elements, at most {} are allowed", count, step.count));
        out.put(count);
        return run_elements(step, count, in, out);
    }
    case Op::array:
        return run_elements(step, step.count, in, out);
    case Op::structure:
        return run_frame(step.frame, in, out);
    case Op::choice:
        return run_choice(step, in, out);
    case Op::constant:
        return run_constant(step, out);
    case Op::length:
        return run_length(step, in, out);
    case Op::refused:
        return run_refused(step, in);
    }
    return false;
}

/// Returns the product of the fields; negative if one of them is.
long double Conversion::product(const ConversionStep::Extent& extent, CdrReader in) const {
    long double product = 1;
    bool negative = false;
    for (std::size_t i = 0; i < extent.slots.size(); ++i) {
        in.seek(slots_[extent.slots[i]]);
        const long double number = get_number(extent.kinds[i], in);
        negative = negative || number < 0;
        product *= number;
    }
    return negative ? -1 : product;
}

/// Returns text for a message: `width x height = 640 x 480`.
std::string Conversion::describe(const ConversionStep::Extent& extent, CdrReader in) const {
    std::string values;
    for (std::size_t i = 0; i < extent.slots.size(); ++i) {
        in.seek(slots_[extent.slots[i]]);
        values += fmt::format("{}{:.0f}", i == 0 ? "" : " x ", get_number(extent.kinds[i], in));
    }
    return fmt::format("{} = {}", extent.text, values);
}

bool Conversion::run_length(const ConversionStep& step, CdrReader& in, CdrWriter& out) {
    const auto count = in.get<std::uint32_t>();
    long double value = count * static_cast<long double>(step.factor);
    if (!step.extent.slots.empty()) {
        const long double cells = product(step.extent, in);
        // Each cell has equally many elements, at least one. More cells than elements do not divide the count.
        const bool divides = cells == 0 ? count == 0
                                        : cells > 0 && count > 0 && cells <= count &&
                                              count % static_cast<std::uint64_t>(cells) == 0;
        if (!divides)
            return fail(step, fmt::format("cannot be computed: '{}' has {} elements, expected 1, 2, ... for "
                                          "each of {}",
                                          step.value, count, describe(step.extent, in)));
        value = cells == 0 ? 0 : count / cells;
    }
    return put_number(step.to.kind, value, out) ||
           fail(step, fmt::format("is {}, which its type cannot hold", static_cast<double>(value)));
}

/// Reduces the count to what the sender's fields state: the elements after it are left out.
bool Conversion::take_first(const ConversionStep& step, std::uint32_t& count, const CdrReader& in) {
    const long double wanted = product(step.extent, in);
    if (!(wanted >= 0 && wanted <= count))
        return fail(step, fmt::format("has {} elements, expected {}", count, describe(step.extent, in)));
    count = static_cast<std::uint32_t>(wanted);
    return true;
}

bool Conversion::run_refused(const ConversionStep& step, CdrReader& in) {
    const auto judge = [&](bool found, std::string_view value) {
        if (found == step.unless) return true;
        const std::string why =
            step.unless ? fmt::format("expected one of {}", fmt::join(step.words, ", ")) : "which is refused";
        return fail(step, fmt::format("is '{}', {}", value.substr(0, 40), why));
    };
    if (step.from.kind != Kind::string) {
        const std::string number = std::to_string(get_integer(step.from.kind, in));
        return judge(std::find(step.words.begin(), step.words.end(), number) != step.words.end(), number);
    }
    const auto text = in.get_string();
    const auto equal = [](char a, char b) { return lower(a) == lower(b); };
    const bool found = std::any_of(step.words.begin(), step.words.end(), [&](const std::string& word) {
        return std::search(text.begin(), text.end(), word.begin(), word.end(), equal) != text.end();
    });
    return judge(found, text);
}

bool Conversion::run_numbers(const ConversionStep& step, std::uint32_t count, CdrReader& in, CdrWriter& out) {
    if (step.op == Op::copy) {
        if (count == 0) return true;
        const std::size_t alignment = primitive_alignment(step.from.kind);
        const auto block = in.get_block(primitive_size(step.from.kind) * count, alignment);
        out.put_block(block.data(), block.size(), alignment);
        return true;
    }
    // The usual case of a unit, without long double.
    if (step.from.kind == Kind::float64 && step.to.kind == Kind::float64) {
        for (; count > 0 && in.ok(); --count) out.put(in.get<double>() * step.factor);
        return true;
    }
    for (; count > 0 && in.ok(); --count) {
        const long double value = get_number(step.from.kind, in) * static_cast<long double>(step.factor);
        if (!put_number(step.to.kind, value, out))
            return fail(step, fmt::format("is {}, which its type cannot hold", static_cast<double>(value)));
    }
    return true;
}

bool Conversion::run_checked(const ConversionStep& step, CdrReader& in, CdrWriter& out) {
    if (step.to.kind == Kind::enumeration) {
        const auto value = in.get<std::uint32_t>();
        out.put(value);
        return value < step.to.count ||
               fail(step, fmt::format("is {}, and the enumeration has {} values", value, step.to.count));
    }
    if (step.to.kind == Kind::wide_character) {
        const auto block = in.get_block(wide_character_bytes, 1);
        out.put_block(block.data(), block.size(), 1);
        return true;
    }
    const auto text = in.get_string();
    out.put_string(text);
    return is_fixed(text, step.to) || fail(step, why_not_fixed(text, step.to));
}

bool Conversion::run_text(const ConversionStep& step, CdrReader& in, CdrWriter& out) {
    std::size_t length = 0;
    if (step.to.kind == Kind::wide_string) {
        const auto bytes = in.get_count(1);
        const auto block = in.get_block(bytes, 1);
        out.put(bytes);
        out.put_block(block.data(), block.size(), 1);
        length = bytes < wide_unit_bytes ? 0 : bytes / wide_unit_bytes - 1; // without the byte order mark
    } else {
        const auto text = in.get_string();
        out.put_string(text);
        length = text.size();
    }
    return step.count == 0 || length <= step.count ||
           fail(step, fmt::format("has {} characters, at most {} are allowed", length, step.count));
}

bool Conversion::run_elements(const ConversionStep& step, std::uint32_t count, CdrReader& in,
                              CdrWriter& out) {
    const ConversionFrame& frame = frames_[step.frame];
    // Handles all numbers in one step, so the elements of an image take one copy.
    if (frame.scan.empty() && frame.steps.size() == 1 && frame.steps.front().count == 1 &&
        (frame.steps.front().op == Op::copy || frame.steps.front().op == Op::number))
        return run_numbers(frame.steps.front(), count, in, out);
    for (; count > 0 && in.ok(); --count)
        if (!run_frame(step.frame, in, out)) return false;
    return true;
}

bool Conversion::run_choice(const ConversionStep& step, CdrReader& in, CdrWriter& out) {
    const Type& kind = step.to.children.front();
    const std::size_t position = in.position();
    const auto discriminator = get_integer(kind.kind, in);
    in.seek(position);
    const auto block = in.get_block(primitive_size(kind.kind), primitive_alignment(kind.kind));
    out.put_block(block.data(), block.size(), primitive_alignment(kind.kind));
    const std::size_t chosen = case_index(step.to, discriminator);
    if (chosen + 1 < step.to.children.size()) return run_frame(step.frame + chosen, in, out);
    const bool is_value = kind.kind != Kind::enumeration || kind.count == 0 || discriminator < kind.count;
    return is_value || fail(step, fmt::format("has the discriminator {}, which has no case", discriminator));
}

bool Conversion::run_constant(const ConversionStep& step, CdrWriter& out) {
    if (step.to.kind == Kind::string || step.to.kind == Kind::fixed)
        out.put_string(step.value);
    else if (primitive_size(step.to.kind) != 0)
        for (std::uint32_t i = 0; i < step.count; ++i) put_number(step.to.kind, step.factor, out);
    else
        out.put(std::uint32_t{0}); // an empty sequence or wide string
    return true;
}

void skip_value(const Type& type, CdrReader& in) {
    if (const std::size_t size = primitive_size(type.kind); size != 0) {
        in.get_block(size, primitive_alignment(type.kind));
        return;
    }
    switch (type.kind) {
    case Kind::string:
    case Kind::fixed:
        in.get_string();
        return;
    case Kind::wide_string:
        in.get_block(in.get_count(1), 1);
        return;
    case Kind::wide_character:
        in.get_block(wide_character_bytes, 1);
        return;
    case Kind::any:
        in.get_string();
        in.get_block(in.get_count(1), 1);
        return;
    case Kind::union_type: {
        const std::size_t chosen = case_index(type, get_integer(type.children.front().kind, in));
        if (chosen + 1 < type.children.size()) skip_value(type.children[chosen + 1], in);
        return;
    }
    case Kind::sequence:
    case Kind::array: {
        const Type& element = type.children.front();
        std::uint32_t count = type.kind == Kind::array ? type.count : in.get_count(1);
        if (const std::size_t size = primitive_size(element.kind); size != 0 && count != 0) {
            in.get_block(size * count, primitive_alignment(element.kind));
            return;
        }
        for (; count > 0 && in.ok(); --count) skip_value(element, in);
        return;
    }
    case Kind::structure:
        for (const Type& member : type.children) skip_value(member, in);
        return;
    default:
        in.fail();
    }
}

} // namespace tandem::wire
