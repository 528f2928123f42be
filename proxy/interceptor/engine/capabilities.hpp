// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tandem::interceptor::engine {

#ifdef TANDEM_RTM_PUBLIC_API
inline constexpr bool has_extensions = false;
#else
inline constexpr bool has_extensions = true;
#endif

/// An InPort gives a connection the buffer named in its profile. OpenRTM-aist's InPorts have one buffer for all
/// connections: messages are written into it on arrival.
inline constexpr bool has_buffer_per_connection = has_extensions;

/// A triggered execution context makes a transition in the requesting thread and forgets no tick. OpenRTM-aist's makes it
/// in its own thread, sleeps for a period after each cycle, and forgets ticks that come during a cycle.
inline constexpr bool has_immediate_transitions = has_extensions;

/// A configuration set shows the default of a bound parameter. OpenRTM-aist's shows an empty text.
inline constexpr bool shows_parameter_defaults = has_extensions;

// Contexts, as a profile names them. In OpenRTM-aist, one name stands for a single shared context.
/// For a component that executes nothing: the context wakes no thread.
inline constexpr const char* idle_context =
    has_extensions ? "SynchExtTriggerEC" : "ExtTrigExecutionContext()";
/// The context's thread sleeps until it is triggered.
inline constexpr const char* triggered_context =
    has_extensions ? "ExtTrigExecutionContext(opros)" : "ExtTrigExecutionContext()";

} // namespace tandem::interceptor::engine
