// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/tandem/import/rtm_setup.hpp"
#include "apps/tandem/import/rts_profile.hpp"

namespace tandem::command {

/// The RTSystem profile of an installation, in its folder or in system/; "" without one. Throws std::runtime_error if there
/// are several.
std::filesystem::path find_rts_profile(const std::filesystem::path& installation);

/// Adds what a person does with the profile in RTSystemEditor: settings and connections of its components. Components that
/// neither precreate nor a module in the installation makes stay in their own processes, and are connected by CORBA.
void add_system(RtmSetup& setup, const RtsProfile& profile, bool activate, ImportReport& report);

} // namespace tandem::command
