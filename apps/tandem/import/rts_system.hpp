// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/tandem/import/rtm_setup.hpp"
#include "apps/tandem/import/rts_profile.hpp"

namespace tandem::command {

/// Returns the RTSystem profile of an installation, in its folder or in system/; "" if there is none. Throws
/// std::runtime_error if there are several.
std::filesystem::path find_rts_profile(const std::filesystem::path& installation);

/// Does what RTSystemEditor does with the profile: sets up and connects its components. Components that cannot be
/// created by precreate or by a module in the installation remain in separate processes and are connected by CORBA.
void add_system(RtmSetup& setup, const RtsProfile& profile, bool activate, ImportReport& report);

} // namespace tandem::command
