// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "host/process/log_throttle.hpp"

namespace tandem::link {

/// The one of host/process, for all rooms of the proxy.
using process::LogThrottle;

} // namespace tandem::link
