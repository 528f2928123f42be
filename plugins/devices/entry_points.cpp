// SPDX-License-Identifier: Apache-2.0
// The two functions by which a component gets a device from its library and may give it back. Compiled once for each library,
// with TANDEM_NEW_DEVICE as the function that TANDEM_DEVICE has made; so without headers.
class OprosApi;

namespace tandem::devices {

OprosApi* TANDEM_NEW_DEVICE();
void delete_device(OprosApi* device);

} // namespace tandem::devices

extern "C" OprosApi* GetAPI() { return tandem::devices::TANDEM_NEW_DEVICE(); }
extern "C" void ReleaseAPI(OprosApi* device) { tandem::devices::delete_device(device); }
