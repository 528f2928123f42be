// SPDX-License-Identifier: Apache-2.0
#include "apps/tandem/opros/type_profile_errors.hpp"

#include "host/opros/engine/profile/type_profile.hpp"

#include <functional>
#include <set>

namespace tandem::command {
namespace {

namespace fs = std::filesystem;

/// Reads the referenced file, relative to the profile's folder, and adds the error if it cannot be parsed.
void check(const fs::path& folder, const std::string& reference,
           const std::function<void(const fs::path&)>& read, std::vector<std::string>& errors) {
    std::error_code ignored;
    if (reference.empty() || !fs::is_regular_file(folder / reference, ignored)) return;
    try {
        read(folder / reference);
    } catch (const engine::SetupError& error) {
        errors.emplace_back(error.what());
    }
}

} // namespace

std::vector<std::string> find_type_profile_errors(const engine::ComponentProfile& profile) {
    const fs::path folder = profile.location.file.parent_path();
    // Sets, because several ports usually refer to one file, whose error is reported once.
    std::set<std::string> services(profile.service_types.begin(), profile.service_types.end());
    for (const auto& port : profile.service_ports) services.insert(port.reference);
    const std::set<std::string> data(profile.data_types.begin(), profile.data_types.end());
    std::vector<std::string> errors;
    for (const std::string& each : services)
        check(
            folder, each, [](const fs::path& file) { engine::read_service_type_profile(file); }, errors);
    for (const std::string& each : data)
        check(
            folder, each, [](const fs::path& file) { engine::read_data_type_profile(file); }, errors);
    return errors;
}

} // namespace tandem::command
