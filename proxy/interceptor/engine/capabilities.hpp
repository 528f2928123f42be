// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::interceptor::engine {

#ifdef TANDEM_RTM_PUBLIC_API
inline constexpr bool has_extensions = false;
#else
inline constexpr bool has_extensions = true;
#endif

/// An InPort gives a connection the buffer that its profile names. OpenRTM-aist's InPorts have one buffer for all of their
/// connections: messages are written into it when they come.
inline constexpr bool has_buffer_per_connection = has_extensions;

/// A triggered execution context makes a transition in the thread that asks for it, and forgets no tick. That of
/// OpenRTM-aist makes it in its own thread, sleeps for a period after each cycle, and forgets ticks that come during one.
inline constexpr bool has_immediate_transitions = has_extensions;

/// A configuration set shows the default of a parameter that is bound; OpenRTM-aist's an empty text.
inline constexpr bool shows_parameter_defaults = has_extensions;

// Contexts, as a profile names them. In OpenRTM-aist a name makes one context of all that have it.
/// Of a component that executes nothing: it wakes no thread by itself.
inline constexpr const char* idle_context =
    has_extensions ? "SynchExtTriggerEC" : "ExtTrigExecutionContext()";
/// Its thread sleeps until it is told.
inline constexpr const char* triggered_context =
    has_extensions ? "ExtTrigExecutionContext(opros)" : "ExtTrigExecutionContext()";

} // namespace tandem::interceptor::engine
