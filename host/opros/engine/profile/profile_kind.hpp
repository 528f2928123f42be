// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

namespace tandem::engine {

/// The kinds of XML files that OPRoS tools write. An application's root element is <package_profile> or
/// <application_profile>.
enum class ProfileKind { component, composite, application, service_type, data_type };

/// Returns the kind of the file according to its root element. Throws SetupError if the file cannot be read, is not
/// well-formed XML, or has another root element.
ProfileKind read_profile_kind(const std::filesystem::path& file);

/// Returns the kind of an XML file in a folder of profiles, or nothing if no profile has its root element, as in data
/// files of components. Throws SetupError if the file cannot be read or is not well-formed XML.
std::optional<ProfileKind> find_profile_kind(const std::filesystem::path& file);

} // namespace tandem::engine
