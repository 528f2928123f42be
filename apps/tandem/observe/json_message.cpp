// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/observe/json_message.hpp"

#include "apps/tandem/output/wide_text.hpp"
#include "host/text/join.hpp"
#include "proxy/wire/cdr.hpp"
#include "proxy/wire/number.hpp"
#include "proxy/wire/signature_match.hpp"
#include "proxy/wire/time.hpp"
#include "proxy/wire/wide_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

namespace tandem::command {
namespace {

using PlainJson = nlohmann::json;
using wire::Kind;
using wire::Type;

/// In bytes. Limits the memory that an array in the type can request.
constexpr std::size_t max_message = 16 << 20;

class Encoder {
  public:
    explicit Encoder(wire::CdrWriter& out) : out_(out) {}

    /// A null stands for an absent value.
    void value(const Type& type, const PlainJson& json, const std::string& path) {
        if (out_.size() > max_message) refuse(path, "a message of at most 16 MiB");
        if (wire::is_number(type.kind) && type.kind != Kind::boolean && type.kind != Kind::character)
            return number(type, json, path);
        switch (type.kind) {
        case Kind::boolean:
            if (!json.is_null() && !json.is_boolean()) refuse(path, "true or false");
            return out_.put_bool(json.is_boolean() && json.get<bool>());
        case Kind::character:
            return character(json, path);
        case Kind::string:
            return text(type, json, path);
        case Kind::wide_character:
            if (const auto text = wide_text(type, json, path); text.size() > 1)
                refuse(path, "a text of one character");
            else
                wire::put_wide_character(out_, text.empty() ? L'\0' : text[0]);
            return;
        case Kind::wide_string:
            wire::put_wide_string(out_, wide_text(type, json, path));
            return;
        case Kind::sequence:
        case Kind::array:
            return list(type, json, path);
        case Kind::structure:
            return structure(type, json, path);
        case Kind::union_type:
            return union_value(type, json, path);
        default:
            refuse(path, "a type that can be sent (no any, fixed, object)");
        }
    }

    void structure(const Type& type, const PlainJson& json, const std::string& path) {
        const bool named = std::all_of(type.children.begin(), type.children.end(),
                                       [](const Type& member) { return !member.name.empty(); });
        if (json.is_array()) { // as message_to_json() writes members without names
            if (json.size() != type.children.size())
                refuse(path, fmt::format("a list of {} members", type.children.size()));
        } else if (!json.is_null() && (!json.is_object() || !named)) {
            refuse(path, named ? "an object" : "a list");
        }
        if (json.is_object())
            for (const auto& item : json.items())
                if (std::none_of(type.children.begin(), type.children.end(),
                                 [&](const Type& member) { return member.name == item.key(); }))
                    refuse(path + "." + item.key(),
                           "one of the members " + text::join(type.children, ", ", &Type::name));
        for (std::size_t i = 0; i < type.children.size(); ++i) {
            const Type& member = type.children[i];
            const std::string name = member.name.empty() ? fmt::format("[{}]", i) : "." + member.name;
            if (json.is_array())
                value(member, json[i], path + name);
            else
                value(member, json.is_null() ? json : json.value(member.name, PlainJson()), path + name);
        }
    }

  private:
    [[noreturn]] static void refuse(const std::string& path, const std::string& expected) {
        throw std::runtime_error(
            fmt::format("{}: expected {}", path.empty() ? "the message" : path.substr(1), expected));
    }

    void number(const Type& type, const PlainJson& json, const std::string& path) {
        const bool floating =
            type.kind == Kind::float32 || type.kind == Kind::float64 || type.kind == Kind::long_double;
        std::optional<long double> number;
        if (json.is_null()) number = 0.0L;
        if (json.is_number_unsigned())
            number = json.get<std::uint64_t>();
        else if (json.is_number_integer())
            number = json.get<std::int64_t>();
        else if (json.is_number_float())
            number = json.get<double>();
        // JSON has no such numbers: message_to_json() writes their names.
        if (floating && json == "nan") number = std::numeric_limits<double>::quiet_NaN();
        if (floating && json == "inf") number = std::numeric_limits<double>::infinity();
        if (floating && json == "-inf") number = -std::numeric_limits<double>::infinity();
        const bool whole = number && (floating || std::floor(*number) == *number);
        const bool known =
            type.kind != Kind::enumeration || type.count == 0 || (number && *number < type.count);
        if (!whole || !known || !wire::put_number(type.kind, *number, out_))
            refuse(path, known ? fmt::format("a number of type '{}'", static_cast<char>(type.kind))
                               : fmt::format("an enumerator's number below {}", type.count));
    }

    void character(const PlainJson& json, const std::string& path) {
        if (json.is_null()) return out_.put<char>('\0');
        if (!json.is_string() || json.get_ref<const std::string&>().size() != 1)
            refuse(path, "a text of one character");
        out_.put<char>(json.get_ref<const std::string&>()[0]);
    }

    void text(const Type& type, const PlainJson& json, const std::string& path) {
        if (json.is_null()) return out_.put_string("");
        if (!json.is_string()) refuse(path, "a text");
        const auto& text = json.get_ref<const std::string&>();
        if (text.find('\0') != std::string::npos || (type.count != 0 && text.size() > type.count))
            refuse(path, type.count == 0 ? "a text without NUL"
                                         : fmt::format("a text of at most {} bytes without NUL", type.count));
        out_.put_string(text);
    }

    static std::wstring wide_text(const Type& type, const PlainJson& json, const std::string& path) {
        if (json.is_null()) return {};
        if (!json.is_string()) refuse(path, "a text");
        const auto text = to_wide(json.get_ref<const std::string&>());
        if (!text) refuse(path, "a text without NUL, with characters up to U+FFFF");
        if (type.kind == Kind::wide_string && type.count != 0 && text->size() > type.count)
            refuse(path, fmt::format("a text of at most {} characters", type.count));
        return *text;
    }

    static std::optional<std::vector<std::uint8_t>> octets(const std::string& digits) {
        std::vector<std::uint8_t> octets;
        const auto digit = [](char c) {
            return c >= '0' && c <= '9'   ? c - '0'
                   : c >= 'a' && c <= 'f' ? c - 'a' + 10
                   : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                          : -1;
        };
        if (digits.size() % 2 != 0) return std::nullopt;
        for (std::size_t i = 0; i < digits.size(); i += 2) {
            const int high = digit(digits[i]), low = digit(digits[i + 1]);
            if (high < 0 || low < 0) return std::nullopt;
            octets.push_back(static_cast<std::uint8_t>(16 * high + low));
        }
        return octets;
    }

    void list(const Type& type, const PlainJson& json, const std::string& path) {
        const Type& element = type.children.at(0);
        const bool is_sequence = type.kind == Kind::sequence;
        if (json.is_string() && element.kind == Kind::octet) {
            const auto bytes = octets(json.get_ref<const std::string&>());
            if (!bytes) refuse(path, "pairs of hexadecimal digits");
            check_length(type, bytes->size(), path);
            if (is_sequence) out_.put(static_cast<std::uint32_t>(bytes->size()));
            return out_.put_block(bytes->data(), bytes->size(), 1);
        }
        if (!json.is_null() && !json.is_array()) refuse(path, "a list");
        const std::size_t count = json.is_null() && !is_sequence ? type.count : json.size();
        check_length(type, count, path);
        if (is_sequence) out_.put(static_cast<std::uint32_t>(count));
        static const PlainJson absent;
        for (std::size_t i = 0; i < count; ++i)
            value(element, json.is_null() ? absent : json[i], fmt::format("{}[{}]", path, i));
    }

    static void check_length(const Type& type, std::size_t count, const std::string& path) {
        if (type.kind == Kind::array && count != type.count)
            refuse(path, fmt::format("{} elements", type.count));
        if (type.kind == Kind::sequence && type.count != 0 && count > type.count)
            refuse(path, fmt::format("at most {} elements", type.count));
    }

    void union_value(const Type& type, const PlainJson& json, const std::string& path) {
        if (!json.is_object() || !json.contains("case") || !json["case"].is_number_integer())
            refuse(path, "an object with the number \"case\"");
        const bool is_unsigned = json["case"].is_number_unsigned();
        const auto label = json["case"].get<std::int64_t>();
        const long double number = is_unsigned ? static_cast<long double>(json["case"].get<std::uint64_t>())
                                               : static_cast<long double>(label);
        if (!wire::put_number(type.children.at(0).kind, number, out_))
            refuse(path + ".case", "a number that the discriminator can have");
        const Type* chosen = nullptr;
        for (std::size_t i = 1; i < type.children.size(); ++i) {
            const auto& labels = type.children[i].labels;
            const bool has_label = std::find(labels.begin(), labels.end(), label) != labels.end();
            if (has_label || (labels.empty() && chosen == nullptr)) chosen = &type.children[i];
        }
        if (chosen == nullptr) return;
        const std::string name = chosen->name.empty() ? "value" : chosen->name;
        value(*chosen, json.value(name, PlainJson()), path + "." + name);
    }

    wire::CdrWriter& out_;
};

} // namespace

nlohmann::json parse_json(std::string_view text) {
    constexpr int max_depth = 64;
    try {
        return PlainJson::parse(text, [](int depth, PlainJson::parse_event_t, PlainJson&) {
            if (depth > max_depth) throw std::runtime_error("expected JSON of at most 64 levels");
            return true;
        });
    } catch (const PlainJson::parse_error& error) {
        throw std::runtime_error(fmt::format("expected JSON: {}", error.what()));
    }
}

std::vector<std::byte> json_to_message(const wire::Type& message, const nlohmann::json& json) {
    std::vector<std::byte> bytes;
    wire::CdrWriter out(bytes);
    PlainJson complete = json;
    const bool timed = wire::is_timed(message) && !message.children[0].name.empty();
    if (timed && complete.is_object() && !complete.contains(message.children[0].name)) {
        const std::uint64_t now = wire::wall_clock_stamp();
        complete[message.children[0].name] =
            PlainJson::array({wire::stamp_seconds(now), wire::stamp_nanoseconds(now)});
    }
    Encoder(out).structure(message, complete, "");
    return bytes;
}

bool takes_bytes(const wire::Type& type) {
    if (type.kind == Kind::any) return false;
    if (type.kind == Kind::structure && type.children.empty()) return false;
    return std::all_of(type.children.begin(), type.children.end(), takes_bytes);
}

} // namespace tandem::command
