// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

namespace tandem::engine {

/// The kinds of XML files that OPRoS tools write. An application's root element is <package_profile> or
/// <application_profile>.
enum class ProfileKind { component, composite, application, service_type, data_type };

/// Reads the file and tells its kind by its root element. Throws SetupError: the file cannot be read, is not
/// well-formed XML, or has another root element.
ProfileKind read_profile_kind(const std::filesystem::path& file);

/// Returns the kind of an XML file in a folder of profiles, or nothing if it has a root element that no profile has, as
/// the data of components do. Throws SetupError: the file cannot be read or is not well-formed XML.
std::optional<ProfileKind> find_profile_kind(const std::filesystem::path& file);

} // namespace tandem::engine
