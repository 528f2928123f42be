// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>

namespace tandem::engine {

/// Does the work in a thread of its own and waits for its end; false when it has not come in time. The thread
/// then goes on alone: what it uses must stay.
bool finishes_within(std::chrono::nanoseconds grace, std::function<void()> work);

/// Whether such a thread still goes on in this process.
bool work_goes_on();

} // namespace tandem::engine
