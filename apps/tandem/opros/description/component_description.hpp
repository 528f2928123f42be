// SPDX-License-Identifier: Apache-2.0
// A component as JSON: written by the child process in which it runs, read by the parent process and by users of
// `tandem opros info --json`.
#pragma once

#include <nlohmann/json.hpp>

class Component;

namespace tandem::command {

/// {"properties": {name: value}, "ports": [{"name", "kind": data|event|service, "direction":
/// input|output|provided|required, "type", "signature", "methods": [{"name", "signature", "call"}]}]}; "type" is null if
/// the port carries any type, "signature" says what crosses a link and is null if nothing can, "methods" exists for
/// services only. Runs the component's code. [child process]
nlohmann::json describe_component(Component& component);

} // namespace tandem::command
