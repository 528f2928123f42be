// SPDX-License-Identifier: Apache-2.0
// Profiles of service types (methods) and of data types (structs). The engine runs an application without them,
// since a component's code has the types; tools and generators read them.
#pragma once

#include "host/opros/engine/profile/setup_error.hpp"

#include <vector>

namespace tandem::engine {

struct ParameterProfile {
    std::string type, name;
    std::string
        direction{}; ///< `in`, `out`, `inout` (ours, as all that is said of IDL here); empty: the type says it
};

struct MethodProfile {
    SourceLocation location;
    std::string name, return_type, call_type; ///< types as written; return_type "void" when there is none
    std::vector<ParameterProfile> parameters; ///< in the order of their index
    std::string attribute{};                  ///< of IDL, for which the method stands; empty: none
    std::vector<std::string> exceptions{};    ///< that it raises, by their full names
};

struct ServiceTypeProfile {
    SourceLocation location;
    std::string name;
    std::vector<MethodProfile> methods;
    std::string idl_name{}; ///< `Module::Interface`; empty when the profile does not say it
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
    std::vector<FieldProfile> fields; ///< of an enumeration: its values, without a type; of an array: one
    Kind kind = Kind::structure;      ///< all but structures are ours
    std::string discriminator{};      ///< of a union: its type
};

class XmlFile;

/// Both read one or more types from a file. Throw SetupError: the file cannot be read, is not well-formed XML
/// or not a profile of this kind, or an element is missing or wrong.
std::vector<ServiceTypeProfile> read_service_type_profile(const std::filesystem::path& file);
std::vector<ServiceTypeProfile> read_service_type_profile(const XmlFile& xml);
std::vector<StructProfile> read_data_type_profile(const std::filesystem::path& file);
std::vector<StructProfile> read_data_type_profile(const XmlFile& xml);

} // namespace tandem::engine
