// SPDX-License-Identifier: Apache-2.0
// What a component shows of itself, as JSON: made in the child process that runs it, read by its parent.
#pragma once

#include <nlohmann/json.hpp>

class Component;

namespace tandem::command {

/// {"properties": {name: value}, "ports": [{"name", "kind": data|event|service, "direction":
/// input|output|provided|required, "type", "methods": [{"name", "signature", "call"}]}]}; "type" is null when
/// the port takes or learns any, "methods" is there for services only.
nlohmann::json describe_component(Component& component);

} // namespace tandem::command
