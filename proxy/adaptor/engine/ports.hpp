// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Component.h>

#include <string>

namespace tandem::adaptor::engine {

/// Removes a port from its component; the engine ends the port's connections. Does nothing if ports cannot be removed
/// (has_changing_ports).
inline void remove_port([[maybe_unused]] Component& owner, [[maybe_unused]] const std::string& name) {
#ifndef TANDEM_OPROS_PUBLIC_API
    owner.removePort(name);
#endif
}

} // namespace tandem::adaptor::engine
