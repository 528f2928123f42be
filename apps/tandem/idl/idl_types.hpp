// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/opros/engine/profile/type_profile.hpp"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::command {

/// Turns the C++ types of OPRoS profiles into IDL types, and declares those that IDL needs declared: sequences, and
/// the structures of data type profiles.
class IdlTypes {
  public:
    /// Declarations go to a module of that name. `structures` are those that types may name.
    IdlTypes(std::string module, const std::vector<engine::StructProfile>& structures);

    /// The IDL type of `std::vector<double>`: `::ArmTypes::DoubleSeq`. Throws std::runtime_error, one line, for a type
    /// that is not known.
    std::string idl_type(const std::string& cxx_type);
    /// The module with the declarations so far; empty if there are none.
    std::string declarations() const;

  private:
    struct Parsed {
        std::string name;
        std::vector<Parsed> arguments; ///< of a template
    };
    class Parser;
    std::string idl_type(const Parsed& type);
    std::string sequence_of(const std::string& element);
    std::string declare_pair(const std::string& key, const std::string& value);
    std::string declare_structure(const std::string& name);
    void declare(const std::string& name, const std::string& declaration);
    std::string in_module(const std::string& name) const { return "::" + module_ + "::" + name; }

    const std::string module_;
    std::map<std::string, const engine::StructProfile*> structures_;
    std::vector<std::string> declared_; ///< names, to declare each once
    std::vector<std::string> open_;     ///< structures whose fields are being looked at
    std::string text_;
};

/// An IDL identifier for a C++ name: words of IDL get the underscore that IDL gives them.
std::string idl_identifier(const std::string& name);

} // namespace tandem::command
