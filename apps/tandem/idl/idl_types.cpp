// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/idl/idl_types.hpp"
#include "apps/tandem/output/idl_identifier.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace tandem::command {
namespace {

/// The types that OPRoS hosts and RTM hosts on one machine share: `long` has 64 bits.
const std::map<std::string, std::string>& simple_types() {
    static const std::map<std::string, std::string> types{
        {"void", "void"},
        {"bool", "boolean"},
        {"char", "char"},
        {"signed char", "char"},
        {"unsigned char", "octet"},
        {"short", "short"},
        {"unsigned short", "unsigned short"},
        {"int", "long"},
        {"unsigned int", "unsigned long"},
        {"unsigned", "unsigned long"},
        {"long", "long long"},
        {"unsigned long", "unsigned long long"},
        {"long long", "long long"},
        {"unsigned long long", "unsigned long long"},
        {"float", "float"},
        {"double", "double"},
        {"long double", "long double"},
        {"wchar_t", "wchar"},
        {"string", "string"},
        {"wstring", "wstring"},
        {"idl::any", "any"},
        {"ReturnType", "long"},
    };
    return types;
}

bool is_sequence(const std::string& name) {
    return name == "vector" || name == "valarray" || name == "deque" || name == "list" || name == "set" ||
           name == "multiset";
}

/// Returns a name for a sequence of this element: `double` -> `DoubleSeq`, `::T::DoubleSeq` -> `DoubleSeqSeq`.
std::string sequence_name(const std::string& element) {
    const auto scope = element.rfind("::");
    std::string name;
    bool capital = true;
    for (const char c : scope == std::string::npos ? element : element.substr(scope + 2)) {
        if (c != ' ') name += capital ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
        capital = c == ' ';
    }
    return name + "Seq";
}

} // namespace

/// Parses types such as `std::map<std::string, unsigned int>`. Spaces matter only between words.
class IdlTypes::Parser {
  public:
    explicit Parser(const std::string& text) : text_(text) {}
    Parsed parse() {
        Parsed type = parse_type(0);
        if (position_ != text_.size()) fail();
        return type;
    }

  private:
    Parsed parse_type(int depth) {
        if (depth > 32) fail();
        Parsed type{parse_name(), {}};
        if (position_ == text_.size() || text_[position_] != '<') return type;
        do {
            ++position_;
            type.arguments.push_back(parse_type(depth + 1));
        } while (position_ < text_.size() && text_[position_] == ',');
        if (position_ == text_.size() || text_[position_] != '>') fail();
        ++position_;
        skip_spaces();
        return type;
    }
    std::string parse_name() {
        std::string name;
        for (skip_spaces(); position_ < text_.size() &&
                            std::string_view("<>,").find(text_[position_]) == std::string_view::npos;
             ++position_)
            name += text_[position_];
        while (!name.empty() && name.back() == ' ') name.pop_back();
        if (name.rfind("std::", 0) == 0) name.erase(0, 5);
        if (name.empty()) fail();
        return name;
    }
    void skip_spaces() {
        while (position_ < text_.size() && text_[position_] == ' ') ++position_;
    }
    [[noreturn]] void fail() const {
        throw std::runtime_error(fmt::format("'{}' is not a supported C++ type", text_));
    }

    const std::string& text_;
    std::size_t position_ = 0;
};

IdlTypes::IdlTypes(std::string module, std::string interface,
                   const std::vector<engine::StructProfile>& structures)
    : module_(std::move(module)), interface_(std::move(interface)) {
    for (const auto& structure : structures) structures_[structure.name] = &structure;
}

std::string IdlTypes::idl_type(const std::string& cxx_type) { return idl_type(Parser(cxx_type).parse()); }

std::string IdlTypes::idl_type(const Parsed& type) {
    const auto simple = simple_types().find(type.name);
    if (type.arguments.empty() && simple != simple_types().end()) return simple->second;
    if (type.arguments.size() == 2 && type.name == "idl::fixed")
        return fixed_of(type.arguments[0].name, type.arguments[1].name);
    if (!type.arguments.empty() && is_sequence(type.name)) return sequence_of(idl_type(type.arguments[0]));
    if (type.arguments.size() == 2 && (type.name == "map" || type.name == "multimap"))
        return sequence_of(declare_pair(idl_type(type.arguments[0]), idl_type(type.arguments[1])));
    if (type.arguments.empty() && structures_.count(type.name)) return declare_type(type.name);
    throw std::runtime_error(fmt::format(
        "type '{}' is unknown; give the data type profile that describes it with --types", type.name));
}

/// A parameter of IDL cannot be a fixed without a name.
std::string IdlTypes::fixed_of(const std::string& digits, const std::string& scale) {
    for (const auto& number : {digits, scale})
        if (number.empty() || number.size() > 2 ||
            number.find_first_not_of("0123456789") != std::string::npos)
            throw std::runtime_error(fmt::format("'idl::fixed<{}, {}>' is not a fixed", digits, scale));
    const std::string name = fmt::format("Fixed{}_{}", digits, scale);
    return declare(name, fmt::format("typedef fixed<{}, {}> {};", digits, scale, name));
}

/// Adds the module to a name without a scope: `Pose` becomes `Module::Pose`, `Robot::Pose` stays.
std::string IdlTypes::full_name(const std::string& name) const {
    return name.find("::") == std::string::npos ? module_ + "::" + name : name;
}

std::string IdlTypes::declare(const std::string& name, const std::string& declaration) {
    const std::string full = full_name(name);
    if (declared_.emplace(full, declaration).second)
        declarations_.push_back({full.substr(0, full.rfind("::")), "  " + declaration + "\n"});
    return idl_scoped_name(full);
}

/// Returns the name, with a number appended if another type has this name.
std::string IdlTypes::free_name(const std::string& scope, const std::string& name) const {
    std::string free = name;
    for (int number = 2; declared_.contains(scope + "::" + free); ++number)
        free = name + std::to_string(number);
    return free;
}

/// Sequences of elements that the interface declares are declared in the interface, others in the module.
std::string IdlTypes::sequence_of(const std::string& element) {
    if (const auto known = sequences_.find(element); known != sequences_.end()) return known->second;
    const bool is_inside = !interface_.empty() && element.starts_with(idl_scoped_name(interface_) + "::");
    const std::string scope = is_inside ? interface_ : module_;
    const std::string name = free_name(scope, sequence_name(element));
    const std::string full =
        declare(scope + "::" + name, fmt::format("typedef sequence<{}> {};", element, name));
    return sequences_[element] = full;
}

std::string IdlTypes::declare_pair(const std::string& key, const std::string& value) {
    const std::string name = sequence_name(key).substr(0, sequence_name(key).size() - 3) +
                             sequence_name(value).substr(0, sequence_name(value).size() - 3) + "Pair";
    return declare(name, fmt::format("struct {} {{ {} first; {} second; }};", name, key, value));
}

/// Declares the members' types first. Throws for a type that contains itself.
std::string IdlTypes::declare_type(const std::string& name) {
    if (declared_.contains(full_name(name))) return idl_scoped_name(full_name(name));
    if (std::find(open_.begin(), open_.end(), name) != open_.end())
        throw std::runtime_error(fmt::format("structure '{}' contains itself", name));
    open_.push_back(name);
    const auto scope = name.rfind("::");
    const std::string text = text_of(
        *structures_.at(name), idl_identifier(scope == std::string::npos ? name : name.substr(scope + 2)));
    open_.pop_back();
    return declare(name, text);
}

std::string IdlTypes::exception(const std::string& name) {
    const auto found = structures_.find(name);
    if (found == structures_.end() || found->second->kind != engine::StructProfile::Kind::exception)
        throw std::runtime_error(fmt::format(
            "exception '{}' is unknown; give the data type profile that describes it with --types", name));
    return declare_type(name);
}

std::string IdlTypes::text_of(const engine::StructProfile& type, const std::string& name) {
    using Kind = engine::StructProfile::Kind;
    switch (type.kind) {
    case Kind::enumeration: {
        std::string values;
        for (const auto& value : type.fields)
            values += (values.empty() ? "" : ", ") + idl_identifier(value.name);
        return fmt::format("enum {} {{ {} }};", name, values);
    }
    case Kind::array:
        return fmt::format("typedef {} {}{};", idl_type(type.fields[0].type), name, type.fields[0].size);
    case Kind::union_type: {
        const std::string discriminator = idl_type(type.discriminator);
        std::string members;
        for (const auto& field : type.fields)
            members += fmt::format(" {}{} {}{};", case_labels(type, field.cases, discriminator),
                                   idl_type(field.type), idl_identifier(field.name), field.size);
        return fmt::format("union {} switch ({}) {{{} }};", name, discriminator, members);
    }
    case Kind::exception:
        return fmt::format("exception {} {{{} }};", name, members_of(type));
    case Kind::structure:
        break;
    }
    return fmt::format("struct {} {{{} }};", name, members_of(type));
}

std::string IdlTypes::members_of(const engine::StructProfile& type) {
    std::string members;
    for (const auto& field : type.fields)
        members += fmt::format(" {} {}{};", idl_type(field.type), idl_identifier(field.name), field.size);
    return members;
}

/// Returns the labels of a union: `97 98` with a character discriminator becomes `case '\x61': case '\x62': `.
std::string IdlTypes::case_labels(const engine::StructProfile& type, const std::string& cases,
                                  const std::string& discriminator) const {
    if (cases == "default") return "default: ";
    std::istringstream labels(cases);
    std::string text;
    for (std::string label; labels >> label;) {
        const bool is_number = label.find_first_not_of("-0123456789") == std::string::npos;
        if (!is_number)
            text += "case " + idl_scoped_name(label) + ": ";
        else if (discriminator == "boolean")
            text += label == "0" ? "case FALSE: " : "case TRUE: ";
        else if (discriminator == "char" && label.size() <= 3)
            text += fmt::format("case '\\x{:02x}': ", std::stoi(label) & 0xff);
        else
            text += "case " + label + ": ";
    }
    if (text.empty())
        throw std::runtime_error(fmt::format("union '{}': a member has no case label", type.name));
    return text;
}

std::string IdlTypes::declarations() const {
    std::string text, scope, block;
    const auto end_block = [&] {
        if (!block.empty()) text += in_modules(scope, block);
        block.clear();
    };
    for (const auto& declaration : declarations_) {
        if (declaration.scope == interface_) continue;
        if (declaration.scope != scope) end_block();
        scope = declaration.scope;
        block += declaration.text;
    }
    end_block();
    return text;
}

std::string IdlTypes::declarations_in_interface() const {
    std::string text;
    for (const auto& declaration : declarations_)
        if (declaration.scope == interface_) text += declaration.text;
    return text;
}

std::string in_modules(const std::string& scope, const std::string& text) {
    if (scope.empty()) return text;
    const auto end = scope.find("::");
    const std::string rest = end == std::string::npos ? "" : scope.substr(end + 2);
    return fmt::format("module {} {{\n{}}};\n", idl_identifier(scope.substr(0, end)), in_modules(rest, text));
}

std::string idl_scoped_name(const std::string& name) {
    const auto end = name.find("::");
    const std::string first = "::" + idl_identifier(name.substr(0, end));
    return end == std::string::npos ? first : first + idl_scoped_name(name.substr(end + 2));
}

} // namespace tandem::command
