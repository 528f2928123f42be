// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tandem::command {

/// A component to try.
struct Candidate {
    std::string name; ///< of its library
    std::filesystem::path folder;
    std::filesystem::path profile{}; ///< OPRoS only
    std::string error{};             ///< why it cannot be tried; "" if it can
};

/// What differs between the models. The functions throw std::runtime_error.
struct CensusModel {
    const char* name;       ///< of the group of sub-commands
    const char* build_name; ///< the option of `build` that selects the component
    /// Finds the components in the folder and below. Adds the number of profiles that have no source to `without_source`.
    std::vector<Candidate> (*find)(const std::filesystem::path& folder, std::size_t& without_source);
    /// Loads the library in a child process. Writes a configuration with the component beside the library. Returns the
    /// command line of a host that runs this configuration.
    std::vector<std::string> (*load)(const Candidate& candidate, const std::filesystem::path& library);
};

extern const CensusModel opros_census_model, rtm_census_model;

} // namespace tandem::command
