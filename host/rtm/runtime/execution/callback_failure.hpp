// SPDX-License-Identifier: Apache-2.0
// Passes on why a callback has failed: from where it is called to where the component's state is published.
#pragma once
#include <string>

namespace RTC {

class RTObject_impl;

/// Keeps for this thread why a callback of the component has failed. [any-thread]
void note_callback_failure(const RTObject_impl* component, std::string text);

/// Returns what this thread has noted last, and forgets it; empty if that was about another component. [any-thread]
std::string take_callback_failure(const RTObject_impl* component);

} // namespace RTC
