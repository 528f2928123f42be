// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/observe/message_json.hpp"

#include "apps/tandem/output/wide_text.hpp"
#include "proxy/wire/number.hpp"
#include "proxy/wire/visit.hpp"
#include "proxy/wire/wide_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>

namespace tandem::command {
namespace {

using Json = nlohmann::ordered_json;
using wire::CdrReader;
using wire::Kind;
using wire::Type;

/// Limit for nested values: an any can contain a message with anys.
constexpr int max_depth = 32;

class Decoder {
  public:
    explicit Decoder(CdrReader& in) : in_(in) {}

    Json value(const Type& type) { return wire::visit(type.kind, *this, type); }

    template <class T>
    Json number(const Type&) {
        if constexpr (std::is_same_v<T, bool>)
            return in_.get_bool();
        else if constexpr (std::is_same_v<T, signed char>)
            return std::string(1, in_.get<char>());
        else if constexpr (std::is_floating_point_v<T>)
            return floating(in_.get<T>());
        else
            return in_.get<T>();
    }
    Json enumeration(const Type&) { return in_.get<std::uint32_t>(); }
    Json wide_character(const Type&) { return to_utf8(wire::get_wide_character(in_)); }
    Json string(const Type&) { return std::string(in_.get_string()); }
    Json wide_string(const Type&) {
        std::wstring text;
        wire::get_wide_string(in_, text);
        return to_utf8(text);
    }
    Json fixed(const Type& type) { return string(type); }
    Json object(const Type& type) { return string(type); }
    Json sequence(const Type& type) { return list(type.children.at(0), in_.get_count(1)); }
    Json array(const Type& type) { return list(type.children.at(0), type.count); }
    Json structure(const Type& type) {
        const bool named = std::all_of(type.children.begin(), type.children.end(),
                                       [](const Type& member) { return !member.name.empty(); });
        Json json = named ? Json::object() : Json::array();
        for (const Type& member : type.children) {
            if (named)
                json[member.name] = value(member);
            else
                json.push_back(value(member));
        }
        return json;
    }
    Json union_type(const Type& type) {
        const wire::Kind discriminator = type.children.at(0).kind;
        const std::int64_t label = wire::get_integer(discriminator, in_);
        const Type* const found = find_case(type, label);
        Json json{{"case", label}};
        if (discriminator == wire::Kind::uint64) json["case"] = static_cast<std::uint64_t>(label);
        if (found != nullptr) json[found->name.empty() ? "value" : found->name] = value(*found);
        return json;
    }
    Json any(const Type&) {
        const std::string signature(in_.get_string());
        const auto bytes = in_.get_block(in_.get_count(1), 1);
        if (!in_.ok() || ++depth_ > max_depth) {
            in_.fail();
            return nullptr;
        }
        CdrReader inner(bytes);
        Decoder decoder(inner);
        decoder.depth_ = depth_;
        Json json{{"type", signature}, {"value", signature.empty() ? Json() : decoder.any_value(signature)}};
        if (!inner.ok()) in_.fail();
        --depth_;
        return json;
    }
    Json unsupported(const Type&) {
        in_.fail();
        return nullptr;
    }

  private:
    static Json floating(long double number) {
        const auto value = static_cast<double>(number);
        return std::isfinite(value) ? Json(value) : Json(fmt::format("{}", value));
    }

    Json list(const Type& element, std::uint32_t count) {
        if (element.kind == Kind::octet) {
            std::string digits;
            for (const std::byte byte : in_.get_block(count, 1))
                digits += fmt::format("{:02x}", static_cast<unsigned>(byte));
            return digits;
        }
        Json list = Json::array();
        // ok() does not stop a list of elements without bytes, see takes_bytes().
        for (std::uint32_t i = 0; i < count && in_.ok(); ++i) list.push_back(value(element));
        return list;
    }

    /// Returns the case with this label, or the default case, which has no label; nullptr if there is neither.
    static const Type* find_case(const Type& type, std::int64_t label) {
        const Type* otherwise = nullptr;
        for (std::size_t i = 1; i < type.children.size(); ++i) {
            const Type& each = type.children[i];
            if (each.labels.empty()) otherwise = &each;
            if (std::find(each.labels.begin(), each.labels.end(), label) != each.labels.end()) return &each;
        }
        return otherwise;
    }

    Json any_value(const std::string& signature) { return value(wire::parse_any_signature(signature)); }

    CdrReader& in_;
    int depth_ = 0;
};

} // namespace

nlohmann::ordered_json message_to_json(const wire::Type& message, std::span<const std::byte> bytes) {
    CdrReader in(bytes);
    Json json = Decoder(in).value(message);
    if (!in.ok())
        throw std::runtime_error(fmt::format("the message of {} bytes is not a valid {}", bytes.size(),
                                             wire::to_named_signature(message)));
    return json;
}

nlohmann::ordered_json message_to_json(const FollowedPort& port, std::span<const std::byte> bytes,
                                       std::uint64_t stamp) {
    std::vector<std::byte> message;
    append_message(port, bytes, stamp, message);
    return message_to_json(port.message, message);
}

} // namespace tandem::command
