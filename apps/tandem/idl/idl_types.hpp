// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/type_profile.hpp"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::command {

/// Converts the C++ types of OPRoS profiles to IDL types. Declares the types that IDL requires to be declared
/// (sequences and types from data type profiles), each before its first use.
class IdlTypes {
  public:
    /// Names without a scope are declared in `module`, `A::T` in module A, and names in the scope of `interface`
    /// (`A::I`) inside the interface. `structures`: the types that profiles may name.
    IdlTypes(std::string module, std::string interface, const std::vector<engine::StructProfile>& structures);

    /// Returns the IDL type of a C++ type: `::ArmTypes::DoubleSeq` for `std::vector<double>`. Throws std::runtime_error
    /// with one line if the type is unknown.
    std::string idl_type(const std::string& cxx_type);
    /// Returns the IDL name of an exception. Throws like idl_type().
    std::string exception(const std::string& name);
    /// Returns the modules with all declarations so far; empty if there are none.
    std::string declarations() const;
    /// Returns the declarations inside the interface.
    std::string declarations_in_interface() const;

  private:
    struct Parsed {
        std::string name;
        std::vector<Parsed> arguments; ///< template arguments
    };
    class Parser;
    std::string idl_type(const Parsed& type);
    std::string sequence_of(const std::string& element);
    std::string fixed_of(const std::string& digits, const std::string& scale);
    std::string declare_pair(const std::string& key, const std::string& value);
    std::string declare_type(const std::string& name);
    std::string text_of(const engine::StructProfile& type, const std::string& name);
    std::string members_of(const engine::StructProfile& type);
    std::string case_labels(const engine::StructProfile& type, const std::string& cases,
                            const std::string& discriminator) const;
    /// Returns the full name of the declared type.
    std::string declare(const std::string& name, const std::string& declaration);
    std::string full_name(const std::string& name) const;
    std::string free_name(const std::string& scope, const std::string& name) const;

    struct Declaration {
        std::string scope, text;
    };
    const std::string module_, interface_;
    std::map<std::string, const engine::StructProfile*> structures_;
    std::vector<std::string> open_;                ///< structures in progress
    std::map<std::string, std::string> sequences_; ///< full names by element
    std::map<std::string, std::string> declared_;  ///< texts by full name
    std::vector<Declaration> declarations_;
};

/// Converts each part of `A::b` with idl_identifier() and prepends `::`.
std::string idl_scoped_name(const std::string& name);
/// Encloses `text` in the modules of `scope`, for example `A::B`.
std::string in_modules(const std::string& scope, const std::string& text);

} // namespace tandem::command
