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

/// The context of a component that executes nothing, as a profile names it: one that wakes no thread by itself.
inline constexpr const char* idle_context =
    has_extensions ? "SynchExtTriggerEC" : "ExtTrigExecutionContext(tandem)";

} // namespace tandem::interceptor::engine
