// SPDX-License-Identifier: Apache-2.0
// A component as JSON. The child process that runs the component writes it; the parent process and users of `tandem
// opros info --json` read it.
#pragma once

#include <nlohmann/json.hpp>

class Component;

namespace tandem::command {

/// Returns {"properties": {name: value}, "ports": [{"name", "kind": data|event|service, "direction":
/// input|output|provided|required, "type", "signature", "methods": [{"name", "signature", "call"}]}]}. "type" is null
/// if the port carries any type. "signature" describes the data on a link; null if they cannot cross a link. Only
/// services have "methods". Runs the component's code. [child process]
nlohmann::json describe_component(Component& component);

} // namespace tandem::command
