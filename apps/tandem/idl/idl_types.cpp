// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/idl/idl_types.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <stdexcept>

namespace tandem::command {
namespace {

/// What OPRoS hosts and RTM hosts of one machine have in common: `long` has 64 bits.
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
        {"string", "string"},
        {"ReturnType", "long"},
    };
    return types;
}

bool is_sequence(const std::string& name) {
    return name == "vector" || name == "valarray" || name == "deque" || name == "list" || name == "set" ||
           name == "multiset";
}

/// A name for a sequence of that element: `double` -> `DoubleSeq`, `::T::DoubleSeq` -> `DoubleSeqSeq`.
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

/// Reads `std::map<std::string, unsigned int>`; spaces count between words only.
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
        throw std::runtime_error(fmt::format("'{}' is no C++ type that can be read", text_));
    }

    const std::string& text_;
    std::size_t position_ = 0;
};

IdlTypes::IdlTypes(std::string module, const std::vector<engine::StructProfile>& structures)
    : module_(std::move(module)) {
    for (const auto& structure : structures) structures_[structure.name] = &structure;
}

std::string IdlTypes::idl_type(const std::string& cxx_type) { return idl_type(Parser(cxx_type).parse()); }

std::string IdlTypes::idl_type(const Parsed& type) {
    const auto simple = simple_types().find(type.name);
    if (type.arguments.empty() && simple != simple_types().end()) return simple->second;
    if (!type.arguments.empty() && is_sequence(type.name)) return sequence_of(idl_type(type.arguments[0]));
    if (type.arguments.size() == 2 && (type.name == "map" || type.name == "multimap"))
        return sequence_of(declare_pair(idl_type(type.arguments[0]), idl_type(type.arguments[1])));
    if (type.arguments.empty() && structures_.count(type.name)) return declare_structure(type.name);
    throw std::runtime_error(fmt::format(
        "type '{}' is not known; give the data type profile that describes it with --types", type.name));
}

void IdlTypes::declare(const std::string& name, const std::string& declaration) {
    if (std::find(declared_.begin(), declared_.end(), name) != declared_.end()) return;
    declared_.push_back(name);
    text_ += "  " + declaration + "\n";
}

std::string IdlTypes::sequence_of(const std::string& element) {
    const std::string name = sequence_name(element);
    declare(name, fmt::format("typedef sequence<{}> {};", element, name));
    return in_module(name);
}

std::string IdlTypes::declare_pair(const std::string& key, const std::string& value) {
    const std::string name = sequence_name(key).substr(0, sequence_name(key).size() - 3) +
                             sequence_name(value).substr(0, sequence_name(value).size() - 3) + "Pair";
    declare(name, fmt::format("struct {} {{ {} first; {} second; }};", name, key, value));
    return in_module(name);
}

/// The fields' types are declared first. Throws for a structure that contains itself.
std::string IdlTypes::declare_structure(const std::string& name) {
    if (std::find(open_.begin(), open_.end(), name) != open_.end())
        throw std::runtime_error(fmt::format("structure '{}' contains itself", name));
    open_.push_back(name);
    std::string fields;
    for (const auto& field : structures_.at(name)->fields)
        fields += fmt::format(" {} {};", idl_type(field.type), idl_identifier(field.name));
    open_.pop_back();
    declare(name, fmt::format("struct {} {{{} }};", name, fields));
    return in_module(name);
}

std::string IdlTypes::declarations() const {
    return text_.empty() ? "" : fmt::format("module {} {{\n{}}};\n", module_, text_);
}

std::string idl_identifier(const std::string& name) {
    static const std::set<std::string> words{
        "abstract", "any",      "attribute", "boolean",   "case",    "char",   "const",       "context",
        "default",  "double",   "enum",      "exception", "factory", "false",  "fixed",       "float",
        "in",       "inout",    "interface", "local",     "long",    "module", "native",      "object",
        "octet",    "oneway",   "out",       "private",   "public",  "raises", "readonly",    "sequence",
        "short",    "string",   "struct",    "supports",  "switch",  "true",   "truncatable", "typedef",
        "union",    "unsigned", "valuebase", "valuetype", "void",    "wchar",  "wstring",     "custom"};
    std::string lower = name;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return words.count(lower) ? "_" + name : name;
}

} // namespace tandem::command
