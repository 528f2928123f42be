// SPDX-License-Identifier: Apache-2.0
// Profiles of service types (methods) and of data types (structs). The engine runs an application without them,
// since a component's code has the types; tools and generators read them.
#pragma once

#include "host/opros/engine/profile/setup_error.hpp"

#include <vector>

namespace tandem::engine {

struct ParameterProfile {
    std::string type, name;
};

struct MethodProfile {
    SourceLocation location;
    std::string name, return_type, call_type; ///< types as written; return_type "void" when there is none
    std::vector<ParameterProfile> parameters; ///< in the order of their index
};

struct ServiceTypeProfile {
    SourceLocation location;
    std::string name;
    std::vector<MethodProfile> methods;
};

struct FieldProfile {
    std::string type, name, default_value;
};

struct StructProfile {
    SourceLocation location;
    std::string name;
    std::vector<FieldProfile> fields;
};

class XmlFile;

/// Both read one or more types from a file. Throw SetupError: the file cannot be read, is not well-formed XML
/// or not a profile of this kind, or an element is missing or wrong.
std::vector<ServiceTypeProfile> read_service_type_profile(const std::filesystem::path& file);
std::vector<ServiceTypeProfile> read_service_type_profile(const XmlFile& xml);
std::vector<StructProfile> read_data_type_profile(const std::filesystem::path& file);
std::vector<StructProfile> read_data_type_profile(const XmlFile& xml);

} // namespace tandem::engine
