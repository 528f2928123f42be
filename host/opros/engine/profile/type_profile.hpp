// SPDX-License-Identifier: Apache-2.0
// Profiles of service types (methods) and data types (structs). The engine runs an application without them, since a
// component's code has the types. Tools and generators read them.
#pragma once

#include "host/opros/engine/profile/setup_error.hpp"

#include <vector>

namespace tandem::engine {

struct ParameterProfile {
    std::string type, name;
    /// `in`, `out` or `inout`; empty: the type determines it. Everything about IDL here is Tandem's extension.
    std::string direction{};
};

struct MethodProfile {
    SourceLocation location;
    std::string name, return_type, call_type; ///< types as written; return_type is "void" if none is given
    std::vector<ParameterProfile> parameters; ///< ordered by index
    std::string attribute{};                  ///< the IDL attribute that the method stands for, or empty
    std::vector<std::string> exceptions{};    ///< exceptions that it raises, by their full names
};

struct ServiceTypeProfile {
    SourceLocation location;
    std::string name;
    std::vector<MethodProfile> methods;
    std::string idl_name{}; ///< `Module::Interface`, or empty if the profile has none
};

struct FieldProfile {
    std::string type, name, default_value;
    std::string size{};  ///< of an array: `[4]`, `[2][3]`
    std::string cases{}; ///< of a union's member: its labels, or `default`
};

struct StructProfile {
    enum class Kind { structure, array, enumeration, union_type, exception };
    SourceLocation location;
    std::string name;
    std::vector<FieldProfile> fields; ///< enumeration: its values, without types; array: one
    Kind kind = Kind::structure;      ///< Tandem adds all kinds except structures
    std::string discriminator{};      ///< type of a union's discriminator
};

class XmlFile;

/// Read one or more types from a file. Throw SetupError if the file cannot be read, is not well-formed XML or not a
/// profile of this kind, or if an element is missing or wrong.
std::vector<ServiceTypeProfile> read_service_type_profile(const std::filesystem::path& file);
std::vector<ServiceTypeProfile> read_service_type_profile(const XmlFile& xml);
std::vector<StructProfile> read_data_type_profile(const std::filesystem::path& file);
std::vector<StructProfile> read_data_type_profile(const XmlFile& xml);

} // namespace tandem::engine
