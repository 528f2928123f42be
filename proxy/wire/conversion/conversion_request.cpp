// SPDX-License-Identifier: Apache-2.0
#include "proxy/wire/conversion/conversion_request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numbers>

namespace tandem::wire {
namespace {

struct Unit {
    std::string_view name, dimension;
    double factor; ///< to the first unit of the dimension
};
constexpr double degree = std::numbers::pi / 180, turn = 2 * std::numbers::pi;
constexpr Unit units[] = {
    {"rad", "angle", 1},
    {"deg", "angle", degree},
    {"m", "length", 1},
    {"cm", "length", 0.01},
    {"mm", "length", 0.001},
    {"km", "length", 1000},
    {"s", "time", 1},
    {"ms", "time", 1e-3},
    {"us", "time", 1e-6},
    {"ns", "time", 1e-9},
    {"kg", "mass", 1},
    {"g", "mass", 0.001},
    {"m/s", "speed", 1},
    {"cm/s", "speed", 0.01},
    {"mm/s", "speed", 0.001},
    {"km/h", "speed", 1 / 3.6},
    {"rad/s", "turning rate", 1},
    {"deg/s", "turning rate", degree},
    {"rpm", "turning rate", turn / 60},
};

std::string_view trimmed(std::string_view text) {
    const auto begin = text.find_first_not_of(" \t\n");
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t\n") - begin + 1);
}

[[noreturn]] void fail(std::string_view item, std::string_view expected) {
    throw ConversionError(fmt::format("conversion '{}': {}", item, expected));
}

const Unit& find_unit(std::string_view item, std::string_view name) {
    const auto at =
        std::find_if(std::begin(units), std::end(units), [&](const Unit& unit) { return unit.name == name; });
    if (at != std::end(units)) return *at;
    std::string known;
    for (const Unit& unit : units) known += (known.empty() ? "" : " ") + std::string(unit.name);
    fail(item, fmt::format("'{}' is not a unit; the units are {}", name, known));
}

double parse_factor(std::string_view item, std::string_view text) {
    if (text.starts_with('*')) {
        const auto number = trimmed(text.substr(1));
        double factor = 0;
        const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), factor);
        if (error != std::errc() || end != number.data() + number.size() || factor == 0)
            fail(item, "expected a number other than 0 after '*'");
        return factor;
    }
    const auto arrow = text.find("->");
    if (arrow == std::string_view::npos)
        fail(item,
             "expected a unit as in 'deg->rad', a factor as in '* 0.001', 'default VALUE', 'from FIELD' or "
             "'count FIELD'");
    const Unit& from = find_unit(item, trimmed(text.substr(0, arrow)));
    const Unit& to = find_unit(item, trimmed(text.substr(arrow + 2)));
    if (from.dimension != to.dimension)
        fail(item,
             fmt::format("{} is a unit of {}, {} of {}", from.name, from.dimension, to.name, to.dimension));
    return from.factor / to.factor;
}

/// Removes the word from the beginning of the text, with the spaces after it. Returns false if the word is not there.
bool take_word(std::string_view& text, std::string_view word) {
    if (!text.starts_with(word)) return false;
    const auto rest = text.substr(word.size());
    if (!rest.empty() && rest.front() != ' ' && rest.front() != '\t') return false;
    text = trimmed(rest);
    return true;
}

/// Splits the text into words at spaces.
std::vector<std::string> split_words(std::string_view text) {
    std::vector<std::string> words;
    for (text = trimmed(text); !text.empty();) {
        const auto end = std::min(text.find_first_of(" \t\n"), text.size());
        words.emplace_back(text.substr(0, end));
        text = trimmed(text.substr(end));
    }
    return words;
}

ConversionRequest::Rule parse_rule(std::string_view item, std::string_view target, std::string_view text) {
    ConversionRequest::Rule rule;
    rule.target = trimmed(target);
    if (rule.target.empty()) fail(item, "expected a field before ':'");
    if (take_word(text, "default")) {
        rule.constant = std::string(text);
        return rule;
    }
    rule.count = take_word(text, "count");
    if (rule.count || take_word(text, "from")) {
        const auto end = text.find_first_of(" \t");
        rule.source = text.substr(0, end);
        if (rule.source.empty()) fail(item, "expected the sender's field");
        text = end == std::string_view::npos ? std::string_view() : trimmed(text.substr(end));
        if (text.empty()) return rule;
        if (take_word(text, rule.count ? "per" : "first")) {
            rule.extent = split_words(text);
            if (rule.extent.empty()) fail(item, "expected fields of the sender at the end");
            return rule;
        }
    }
    rule.factor = parse_factor(item, text);
    return rule;
}

ConversionRequest::Refusal parse_refusal(std::string_view item, std::string_view text) {
    auto words = split_words(text);
    const bool unless = words.size() > 1 && words[1] == "unless";
    const std::size_t first = unless ? 2 : 1;
    if (words.size() <= first) fail(item, "expected the sender's field and a word or number after 'refuse'");
    ConversionRequest::Refusal refusal{words.front(), {}, unless};
    refusal.words.assign(words.begin() + static_cast<std::ptrdiff_t>(first), words.end());
    return refusal;
}

void add_item(ConversionRequest& request, std::string_view item) {
    if (const auto colon = item.find(':'); colon != std::string_view::npos) {
        request.rules.push_back(parse_rule(item, item.substr(0, colon), trimmed(item.substr(colon + 1))));
        return;
    }
    std::string_view rest = item;
    if (item == "widen")
        request.widen = true;
    else if (item == "narrow")
        request.widen = request.narrow = true;
    else if (item == "reorder")
        request.reorder = true;
    else if (item == "positions")
        request.positions = true;
    else if (item == "drop tm")
        request.drop_time = true;
    else if (item == "set tm")
        request.set_time = true;
    else if (take_word(rest, "drop") && !rest.empty())
        request.dropped.emplace_back(rest);
    else if (take_word(rest, "refuse"))
        request.refusals.push_back(parse_refusal(item, rest));
    else
        fail(item, "expected: widen, narrow, reorder, positions, 'drop tm', 'set tm', 'drop FIELD', "
                   "'refuse FIELD WORD', or 'FIELD: ...'");
}

} // namespace

bool ConversionRequest::empty() const {
    return !widen && !reorder && !positions && !drop_time && !set_time && dropped.empty() && rules.empty() &&
           refusals.empty();
}

const ConversionRequest::Rule* ConversionRequest::find(std::string_view target) const {
    const auto at =
        std::find_if(rules.begin(), rules.end(), [&](const Rule& rule) { return rule.target == target; });
    return at == rules.end() ? nullptr : &*at;
}

ConversionRequest parse_conversion_request(std::string_view text) {
    ConversionRequest request;
    while (!text.empty()) {
        const auto end = text.find(';');
        if (const auto item = trimmed(text.substr(0, end)); !item.empty()) add_item(request, item);
        text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    }
    return request;
}

} // namespace tandem::wire
