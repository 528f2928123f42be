// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proxy/interceptor/engine/rtm_api.hpp"

#include <string>

namespace tandem::interceptor::engine {

/// Throw std::runtime_error, one line. [any-thread]
void load_module(RTC::Manager& manager, const std::string& module);
/// `arguments`: a type and properties, as in manager.components.precreate.
RTC::RTObject_impl& create_component(RTC::Manager& manager, const std::string& arguments);

/// Ends a component and removes it; without extensions of the engine the manager does the latter within a second.
void remove_component(RTC::Manager& manager, RTC::RTObject_impl& component);
/// For registerFactory(): deletes a component when the last reference to its servant has gone.
void release_component(RTC::RTObject_impl* component);
/// Waits, 3 s at most, until a component of that name that was removed has gone. Not in the manager's thread.
void wait_until_removed(RTC::Manager& manager, const std::string& name);

/// Whether the manager ends. Before the first question: watch_termination(). [any-thread]
bool is_terminating();
void watch_termination(RTC::Manager& manager);

/// Components of that name, here or elsewhere. None: `reason` is one line. With extensions of the engine each call of another
/// process ends within `timeout_ms`, without them within the ORB's time limit.
RTC::RTCList find_by_name(RTC::Manager& manager, const std::string& name, std::string& reason,
                          CORBA::ULong timeout_ms);

/// Whether the servant, an InPort, has listeners that want each message when it comes, or has to be given it then.
bool wants_arrivals(RTC::InPortBase& port);

} // namespace tandem::interceptor::engine
