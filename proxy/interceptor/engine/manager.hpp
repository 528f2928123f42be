// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/engine/rtm_api.hpp"

#include <string>

namespace tandem::interceptor::engine {

/// Throw std::runtime_error, one line. [any-thread]
void load_module(RTC::Manager& manager, const std::string& module);
/// `arguments`: a type and properties, as in manager.components.precreate.
RTC::RTObject_impl& create_component(RTC::Manager& manager, const std::string& arguments);

/// Ends a component and removes it. Without extensions of the engine the manager removes it within a second.
void remove_component(RTC::Manager& manager, RTC::RTObject_impl& component);
/// For registerFactory(): deletes a component when the last reference to its servant is gone.
void release_component(RTC::RTObject_impl* component);
/// Waits at most 3 s until a removed component of this name is gone. Not in the manager's thread.
void wait_until_removed(RTC::Manager& manager, const std::string& name);

/// Returns whether the manager is ending. Call watch_termination() before. [any-thread]
bool is_terminating();
void watch_termination(RTC::Manager& manager);

/// Returns the components with this name, in this process or another. If there are none, sets `reason` to one line. Each
/// call to another process ends within `timeout_ms`, or, if the engine has no extensions, within the ORB's time limit.
RTC::RTCList find_by_name(RTC::Manager& manager, const std::string& name, std::string& reason,
                          CORBA::ULong timeout_ms);

/// Returns whether the InPort must get each message on arrival: it has listeners, or the engine shows none of them.
bool wants_arrivals(RTC::InPortBase& port);

} // namespace tandem::interceptor::engine
