// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::adaptor::engine {

#ifdef TANDEM_OPROS_PUBLIC_API
inline constexpr bool has_extensions = false;
#else
inline constexpr bool has_extensions = true;
#endif

/// A component can add and remove ports at any time, which makes and ends connections of the application profile. A real
/// engine connects only the ports that a component has after onInitialize().
inline constexpr bool has_changing_ports = has_extensions;

/// An event port provides a value of the type of its contents.
inline constexpr bool ports_show_content = has_extensions;

} // namespace tandem::adaptor::engine
