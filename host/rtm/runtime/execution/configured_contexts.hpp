// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <coil/Properties.h>
#include <vector>

namespace RTC {

/// The contexts a component with these properties is to own, each as its options with `type` and, when it has
/// one, `name`: what `execution_contexts` lists (`type(name), ...`, or none), otherwise the one of
/// `exec_cxt`. Options come from `exec_cxt`, `ec.<type>` and `ec.<name>`; the later win. Throws ManagerError.
std::vector<coil::Properties> configured_contexts(const coil::Properties& component);

} // namespace RTC
