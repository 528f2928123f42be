// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/rtm/running/running_commands.hpp"

#include <nlohmann/json.hpp>

namespace tandem::command {

/// Sets values, then activates a set, and reads back what the component has. `host_checks`: the component's host refuses
/// values that its parameters cannot hold. Throws std::runtime_error, CORBA::Exception and what SDOPackage declares.
void change_configuration(SDOPackage::Configuration_ptr configuration, const ConfOptions& options,
                          bool host_checks);

/// All configuration sets: a list of {set, active, values: {NAME: TEXT}}. Throws as above.
nlohmann::json sets_json(SDOPackage::Configuration_ptr configuration);

} // namespace tandem::command
