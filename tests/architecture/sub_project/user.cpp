// SPDX-License-Identifier: Apache-2.0
#include "host/process/log_throttle.hpp"

int main() { return tandem::process::LogThrottle().should_log() ? 0 : 1; }
