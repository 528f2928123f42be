// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <functional>

namespace RTC {

/// Calls a component's code in a thread of its own. False: it has not returned within the bound; its thread
/// is left behind. What it throws in time is thrown here.
bool returns_within(std::chrono::nanoseconds bound, std::function<void()> call);

} // namespace RTC
