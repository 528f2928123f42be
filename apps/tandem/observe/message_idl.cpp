// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/observe/message_idl.hpp"
#include "apps/tandem/output/idl_identifier.hpp"
#include "proxy/wire/visit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <set>
#include <string_view>

namespace tandem::command {
namespace {

using wire::Kind;
using wire::Type;

/// Returns an IDL identifier for any text.
std::string identifier(std::string_view text) {
    std::string word;
    for (const char c : text) word += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    if (word.empty() || std::isdigit(static_cast<unsigned char>(word[0])) != 0) word = "m" + word;
    return idl_identifier(word);
}

/// Returns `IDL:RTC/TimedDoubleSeq:1.0` as RTC::TimedDoubleSeq, and any other name as one identifier.
std::vector<std::string> scoped_name(std::string type) {
    if (type.rfind("IDL:", 0) == 0) type = type.substr(4, type.rfind(':') - 4);
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= type.size();) {
        const std::size_t end = std::min(type.find('/', begin), type.size());
        parts.push_back(identifier(std::string_view(type).substr(begin, end - begin)));
        begin = end + 1;
    }
    return parts;
}

constexpr const char* number_name(bool) { return "boolean"; }
constexpr const char* number_name(signed char) { return "char"; }
constexpr const char* number_name(std::uint8_t) { return "octet"; }
constexpr const char* number_name(std::int16_t) { return "short"; }
constexpr const char* number_name(std::uint16_t) { return "unsigned short"; }
constexpr const char* number_name(std::int32_t) { return "long"; }
constexpr const char* number_name(std::uint32_t) { return "unsigned long"; }
constexpr const char* number_name(std::int64_t) { return "long long"; }
constexpr const char* number_name(std::uint64_t) { return "unsigned long long"; }
constexpr const char* number_name(float) { return "float"; }
constexpr const char* number_name(double) { return "double"; }
constexpr const char* number_name(long double) { return "octet"; } // member() declares two words

/// Writes the types that a message needs, innermost first.
class IdlWriter {
  public:
    /// Returns the structure's name.
    std::string declare_structure(const Type& type, const std::string& name) {
        std::string members;
        for (std::size_t i = 0; i < type.children.size(); ++i)
            members += "  " + member(type.children[i], member_name(type.children[i], i), name) + ";\n";
        if (members.empty()) members = "  octet empty[0];\n";
        text_ += fmt::format("struct {} {{\n{}}};\n", name, members);
        return name;
    }
    const std::string& text() const { return text_; }

  private:
    static std::string member_name(const Type& type, std::size_t position) {
        return type.name.empty() ? fmt::format("member_{}", position) : identifier(type.name);
    }

    /// Returns a name that no other type in this text has.
    std::string fresh(const std::string& outer, const std::string& inner) {
        const std::string base = outer + "_" + (inner[0] == '_' ? inner.substr(1) : inner);
        std::string name = base;
        for (int i = 2; !names_.insert(name).second; ++i) name = fmt::format("{}_{}", base, i);
        return name;
    }

    /// Returns a member's declaration, for example `double data[3]`.
    std::string member(const Type& type, const std::string& name, const std::string& outer) {
        switch (type.kind) {
        case Kind::array:
            return fmt::format("{} {}[{}]", element(type.children.at(0), name, outer), name, type.count);
        case Kind::wide_character:
            return fmt::format("octet {}[3]", name);
        case Kind::long_double:
            return fmt::format("unsigned long long {}[2]", name);
        default:
            return type_of(type, name, outer) + " " + name;
        }
    }

    /// Wraps an element that is a sequence or an array in a structure, because not every tool reads it directly. The
    /// bytes stay the same.
    std::string element(const Type& type, const std::string& name, const std::string& outer) {
        const bool plain = type.kind != Kind::sequence && type.kind != Kind::array &&
                           type.kind != Kind::wide_string && type.kind != Kind::wide_character &&
                           type.kind != Kind::long_double;
        if (plain) return type_of(type, name, outer);
        Type wrapped;
        wrapped.children.push_back(type);
        wrapped.children[0].name = "value";
        return declare_structure(wrapped, fresh(outer, name));
    }

    std::string type_of(const Type& type, const std::string& name, const std::string& outer) {
        return wire::visit(type.kind, TypeName{*this, type, name, outer});
    }

    /// The type as a member's declaration names it. member() and element() handle types with several elements.
    struct TypeName {
        IdlWriter& writer;
        const Type& type;
        const std::string &name, &outer;

        template <class T>
        std::string number() const {
            return number_name(T{});
        }
        std::string enumeration() const { return "unsigned long"; }
        std::string wide_character() const { return "octet"; }
        std::string string() const {
            return type.count == 0 ? "string" : fmt::format("string<{}>", type.count);
        }
        std::string wide_string() const { return "sequence<octet>"; }
        std::string fixed() const { return "string"; }
        std::string object() const { return "string"; }
        std::string any() const {
            if (writer.names_.insert("Any").second)
                writer.text_ += "struct Any {\n  string type;\n  sequence<octet> value;\n};\n";
            return "Any";
        }
        std::string sequence() const {
            const std::string of = writer.element(type.children.at(0), name, outer);
            return type.count == 0 ? fmt::format("sequence<{}>", of)
                                   : fmt::format("sequence<{}, {}>", of, type.count);
        }
        std::string array() const { return "octet"; }
        std::string structure() const { return writer.declare_structure(type, writer.fresh(outer, name)); }
        std::string union_type() const { return writer.declare_union(type, writer.fresh(outer, name)); }
        std::string unsupported() const { return "octet"; } // such a port has no ring
    };

    std::string declare_union(const Type& type, const std::string& name) {
        const Type& discriminator = type.children.at(0);
        std::string cases;
        for (std::size_t i = 1; i < type.children.size(); ++i) {
            const Type& each = type.children[i];
            for (const auto label : each.labels)
                cases += "  case " + label_of(discriminator.kind, label) + ":\n";
            if (each.labels.empty()) cases += "  default:\n";
            cases += "    " + member(each, member_name(each, i), name) + ";\n";
        }
        text_ += fmt::format("union {} switch ({}) {{\n{}}};\n", name,
                             type_of(discriminator, "discriminator", name), cases);
        return name;
    }

    static std::string label_of(Kind kind, std::int64_t label) {
        if (kind == Kind::boolean) return label != 0 ? "TRUE" : "FALSE";
        return wire::label_text(kind, label);
    }

    std::string text_;
    std::set<std::string> names_;
};

} // namespace

MessageIdl message_idl(const FollowedPort& port) { return message_idl(port.port.type, port.message); }

MessageIdl message_idl(const std::string& type, const wire::Type& message) {
    const auto scope = scoped_name(type);
    IdlWriter writer;
    writer.declare_structure(message, scope.back());
    MessageIdl idl{scope.back(), writer.text()};
    for (auto module = scope.rbegin() + 1; module != scope.rend(); ++module) {
        idl.name = *module + "::" + idl.name;
        idl.text = fmt::format("module {} {{\n{}}};\n", *module, idl.text);
    }
    return idl;
}

wire::Type with_member_names(wire::Type message, bool has_result) {
    for (std::size_t i = 0; i < message.children.size(); ++i)
        if (auto& name = message.children[i].name; name.empty())
            name = has_result && i == 0 ? "result" : fmt::format("argument_{}", i);
    return message;
}

} // namespace tandem::command
