// SPDX-License-Identifier: Apache-2.0
// Profiles of service types and of data types. The engine needs neither to run an application: they are what
// tools and generators know of a component's signatures.
#pragma once

#include "host/opros/engine/profile/profile.hpp"

namespace tandem::engine {

struct ParameterProfile {
    std::string type, name;
};

struct MethodProfile {
    SourceLocation location;
    std::string name, return_type, call_type;
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

/// Both throw SetupError: no such file, not well-formed, not a profile of this kind, or something missing or
/// wrong.
std::vector<ServiceTypeProfile> read_service_type_profile(const std::filesystem::path& file);
std::vector<StructProfile> read_data_type_profile(const std::filesystem::path& file);
std::vector<ServiceTypeProfile> read_service_type_profile(const XmlFile& xml);
std::vector<StructProfile> read_data_type_profile(const XmlFile& xml);

} // namespace tandem::engine
