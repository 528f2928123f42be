// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace tandem::engine {

/// The kinds of XML files that OPRoS tools write. An application's root element is <package_profile> or
/// <application_profile>.
enum class ProfileKind { component, composite, application, service_type, data_type };

/// Reads the file and tells its kind by its root element. Throws SetupError: the file cannot be read, is not
/// well-formed XML, or has another root element.
ProfileKind read_profile_kind(const std::filesystem::path& file);

} // namespace tandem::engine
