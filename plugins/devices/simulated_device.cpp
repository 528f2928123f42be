// SPDX-License-Identifier: Apache-2.0
// What entry_points.cpp calls of every device, since it has no headers.
#include <device/OprosApi.h>

namespace tandem::devices {

void delete_device(OprosApi* device) { delete device; }

} // namespace tandem::devices
