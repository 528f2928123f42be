// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/type_profile.hpp"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::command {

/// Turns the C++ types of OPRoS profiles into IDL types, and declares those that IDL needs declared: sequences, and
/// the types of data type profiles, each before what uses it.
class IdlTypes {
  public:
    /// Declarations of names without a scope go to a module of that name, those of `A::T` to module A, those of names in
    /// the scope of `interface`, `A::I`, into it. `structures` are those that types may name.
    IdlTypes(std::string module, std::string interface, const std::vector<engine::StructProfile>& structures);

    /// The IDL type of `std::vector<double>`: `::ArmTypes::DoubleSeq`. Throws std::runtime_error, one line, for a type
    /// that is not known.
    std::string idl_type(const std::string& cxx_type);
    /// The IDL name of an exception, likewise.
    std::string exception(const std::string& name);
    /// The modules with the declarations so far; empty if there are none.
    std::string declarations() const;
    /// Those inside of the interface.
    std::string declarations_in_interface() const;

  private:
    struct Parsed {
        std::string name;
        std::vector<Parsed> arguments; ///< of a template
    };
    class Parser;
    std::string idl_type(const Parsed& type);
    std::string sequence_of(const std::string& element);
    std::string declare_pair(const std::string& key, const std::string& value);
    std::string declare_type(const std::string& name);
    std::string text_of(const engine::StructProfile& type, const std::string& name);
    std::string members_of(const engine::StructProfile& type);
    std::string case_labels(const engine::StructProfile& type, const std::string& cases,
                            const std::string& discriminator) const;
    /// Returns the full name of what is declared.
    std::string declare(const std::string& name, const std::string& declaration);
    std::string full_name(const std::string& name) const;
    std::string free_name(const std::string& scope, const std::string& name) const;

    struct Declaration {
        std::string scope, text;
    };
    const std::string module_, interface_;
    std::map<std::string, const engine::StructProfile*> structures_;
    std::vector<std::string> open_;                ///< structures whose fields are being looked at
    std::map<std::string, std::string> sequences_; ///< full names, by their elements
    std::map<std::string, std::string> declared_;  ///< texts, by full names
    std::vector<Declaration> declarations_;
};

/// An IDL identifier for a C++ name: words of IDL get the underscore that IDL gives them.
std::string idl_identifier(const std::string& name);
/// The same of `A::b`, part by part; with `::` in front.
std::string idl_scoped_name(const std::string& name);
/// `text` in modules of these names: `A::B`.
std::string in_modules(const std::string& scope, const std::string& text);

} // namespace tandem::command
