// SPDX-License-Identifier: Apache-2.0
#include <device/OprosApi.h>

namespace tandem::devices {

void delete_device(OprosApi* device) { delete device; }

} // namespace tandem::devices
