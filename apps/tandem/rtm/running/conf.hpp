// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "apps/tandem/rtm/running/rtm_client.hpp"
#include "apps/tandem/rtm/running/running_commands.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace tandem::command {

/// Sets values, activates a set, and verifies the component's values. `host_checks`: the component's host refuses
/// values that its parameters cannot hold. Throws std::runtime_error, CORBA::Exception and the exceptions of
/// SDOPackage.
void change_configuration(SDOPackage::Configuration_ptr configuration, const ConfOptions& options,
                          bool host_checks);

/// Returns all configuration sets as a list of {set, active, values: {NAME: TEXT}}. Throws like change_configuration().
nlohmann::json sets_json(SDOPackage::Configuration_ptr configuration);

/// Runs `action`, which calls the two functions above. Converts their exceptions to std::runtime_error with one line.
template <class Action>
void call_configuration(const RemoteComponent& component, Action action) {
    try {
        action();
    } catch (const SDOPackage::InvalidParameter& e) {
        throw std::runtime_error(component.instance + ": " + e.description.in());
    } catch (const SDOPackage::InternalError& e) {
        throw std::runtime_error(component.instance + ": " + e.description.in());
    } catch (const CORBA::Exception& e) {
        throw_corba_error(component.address, e);
    }
}

} // namespace tandem::command
