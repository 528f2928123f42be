// SPDX-License-Identifier: Apache-2.0
// The functions with which a component gets a device from its library and returns it. Compiled once for each library.
// TANDEM_NEW_DEVICE is the function that TANDEM_DEVICE defines, so no header is needed.
class OprosApi;

namespace tandem::devices {

OprosApi* TANDEM_NEW_DEVICE();
void delete_device(OprosApi* device);

} // namespace tandem::devices

extern "C" OprosApi* GetAPI() { return tandem::devices::TANDEM_NEW_DEVICE(); }
extern "C" void ReleaseAPI(OprosApi* device) { tandem::devices::delete_device(device); }
