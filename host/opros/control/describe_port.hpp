// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Port.h>

#include <nlohmann/json.hpp>

namespace tandem::control {

/// Returns data, event or service.
const char* kind_name(PortType type);

/// Returns {"kind": data|event|service, "direction": input|output|provided|required, "type"}, for services with
/// "methods": [{"name", "signature", "call": blocking|nonblocking}]. "type" is null if the port carries any type, and for
/// services. A method's signature is that of the compiled C++ function.
nlohmann::json describe_port(Port& port);

} // namespace tandem::control
