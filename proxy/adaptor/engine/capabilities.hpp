// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::adaptor::engine {

#ifdef TANDEM_OPROS_PUBLIC_API
inline constexpr bool has_extensions = false;
#else
inline constexpr bool has_extensions = true;
#endif

/// A component can take a port away and add one at any time, which ends and makes the connections of the application
/// profile. In a real engine the ports that a component has after onInitialize() are all that are ever connected.
inline constexpr bool has_changing_ports = has_extensions;

/// A port for events has a value of the type of their contents.
inline constexpr bool ports_show_content = has_extensions;

} // namespace tandem::adaptor::engine
