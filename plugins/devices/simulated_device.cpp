// SPDX-License-Identifier: Apache-2.0
// Called by entry_points.cpp for every device, because that file includes no headers.
#include <device/OprosApi.h>

namespace tandem::devices {

void delete_device(OprosApi* device) { delete device; }

} // namespace tandem::devices
